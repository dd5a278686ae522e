// Runs the Khronos glTF validator over files: node validate.mjs FILE... Exit 0: no error and no warning in any; 1: some; 77: the
// npm package gltf-validator is not there. It is looked for in DIPTYCH_NODE_MODULES, else in build/node_modules of the sources.
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const modules = process.env.DIPTYCH_NODE_MODULES || join(root, "build", "node_modules");
if (!existsSync(join(modules, "gltf-validator"))) {
    console.log(`SKIPPED: no gltf-validator in ${modules}`);
    process.exit(77);
}
const validator = createRequire(join(resolve(modules), "index.js"))("gltf-validator");

let failed = process.argv.length < 3;
for (const file of process.argv.slice(2)) {
    const report = await validator.validateBytes(new Uint8Array(await readFile(file)), {
        uri: file,
        maxIssues: 20,
        externalResourceFunction: async (uri) => new Uint8Array(await readFile(join(dirname(file), decodeURIComponent(uri)))),
    });
    const { numErrors, numWarnings, numInfos, messages } = report.issues;
    console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos`);
    for (const { severity, code, message, pointer } of messages.filter((m) => m.severity <= 1)) {
        console.log(`  ${severity === 0 ? "error" : "warning"} ${code} at ${pointer}: ${message}`);
    }
    failed ||= numErrors + numWarnings > 0;
}
process.exit(failed ? 1 : 0);
