// node validate_gltf.js PACKAGE_FOLDER FILE...: exit 1 where the Khronos validator finds an error or a warning in a file.
const fs = require('fs');
const path = require('path');
const [packageFolder, ...files] = process.argv.slice(2);
const validator = require(path.resolve(packageFolder, 'gltf-validator'));

async function validate(file) {
    const folder = path.dirname(path.resolve(file));
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
        uri: file,
        externalResourceFunction: async (uri) =>
            new Uint8Array(fs.readFileSync(path.resolve(folder, decodeURIComponent(uri)))),
    });
    const faults = report.issues.messages.filter((message) => message.severity <= 1);
    for (const fault of faults.slice(0, 10)) {
        console.log(`${file}: ${fault.code} at ${fault.pointer}: ${fault.message}`);
    }
    console.log(`${file}: ${report.issues.numErrors} errors, ${report.issues.numWarnings} warnings`);
    return faults.length === 0;
}

(async () => {
    let valid = files.length > 0;
    for (const file of files) {
        valid = (await validate(file)) && valid;
    }
    process.exit(valid ? 0 : 1);
})();
