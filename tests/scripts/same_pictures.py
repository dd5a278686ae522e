#!/usr/bin/env python3
"""Shows that a change of the code changes no picture: renders every own scene under many settings, and compares to the bit.

    same_pictures.py record PROGRAM FILE    # before the change: writes a hash of each picture
    same_pictures.py check PROGRAM FILE     # after it: names the pictures that differ; exit 1 where one does

Both panels, where the machine has a Vulkan device. Hashes are of the pixels of all layers, since metadata names the commit.
"""
import concurrent.futures
import hashlib
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
SMALL = "--size 40x24 --spp 4 --max-depth 5".split()
# By name: options of `render`. What a setting refuses on a scene is compared as well, by its message.
SETTINGS = {
    "brdf": "--integrator brdf",
    "direct": "--integrator direct --mis balance",
    "path": "--integrator path",
    "path-blinn-phong": "--integrator path --brdf blinn-phong --sampler independent --seed 7",
    "path-hammersley": "--integrator path --sampler hammersley --normal-maps microfacet",
    "path-generic": "--integrator path --generic",
    "path-lens": "--integrator path --aperture 0.02 --focus 2 --sun 30,50,2 --env 0.4,0.5,0.6",
    "ris": "--integrator ris",
    "restir": "--integrator restir",
    "restir-target": "--integrator restir --reuse-visibility target --reuse-mis pairwise --spatial-passes 2",
    "restir-balance": "--integrator restir --reuse-mis balance --brdf blinn-phong",
    "restir-z": "--integrator restir --reuse-mis 1-over-z --near-share 0",
    "frames": "--integrator restir --frames 3 --orbit 4 --start 0.1",
}
EXTREMES = ["path", "restir-target"]


def pixels_hash(path):
    """Of an EXR's scan lines, whatever its header says."""
    data, at, attributes = path.read_bytes(), 8, {}
    while data[at]:
        end = data.index(0, at)
        kind = data.index(0, end + 1)
        size = struct.unpack_from("<i", data, kind + 1)[0]
        attributes[data[at:end]] = data[kind + 5 : kind + 5 + size]
        at = kind + 5 + size
    _, top, _, bottom = struct.unpack("<4i", attributes[b"dataWindow"])
    sum_ = hashlib.sha256(attributes[b"channels"])
    for offset in struct.unpack_from(f"<{(bottom - top + 16) // 16}Q", data, at + 1):
        _, size = struct.unpack_from("<2i", data, offset)
        block = data[offset + 8 : offset + 8 + size]
        try:
            block = zlib.decompress(block)
        except zlib.error:
            pass  # stored as it is
        sum_.update(block)
    return sum_.hexdigest()


def picture(program, scene, backend, setting):
    with tempfile.TemporaryDirectory() as folder:
        output = pathlib.Path(folder) / "out.exr"
        command = [program, "render", scene, "--backend", backend, *SMALL, *SETTINGS[setting].split(), "-o", output]
        if backend == "cpu":
            command += ["--threads", "1"]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode:
            return f"exit {run.returncode}: {run.stderr.replace(folder, '').strip().splitlines()[-1]}"
        return " ".join(pixels_hash(path) for path in sorted(pathlib.Path(folder).glob("*.exr")))


def jobs(program):
    scenes = sorted((ROOT / "scenes").glob("*.gltf")), sorted((ROOT / "scenes" / "extremes").glob("*.gltf"))
    devices = subprocess.run([program, "info", "--devices"], capture_output=True, text=True).stdout
    backends = ["cpu", "vulkan"] if "Vulkan" in devices else ["cpu"]
    for group, settings in zip(scenes, (SETTINGS, EXTREMES)):
        for scene in group:
            for setting in settings:
                for backend in backends:
                    yield scene, backend, setting


def pictures(program):
    with concurrent.futures.ThreadPoolExecutor() as pool:
        names = {f"{scene.relative_to(ROOT)} {backend} {setting}": pool.submit(picture, program, scene, backend, setting)
                 for scene, backend, setting in jobs(program)}
        return {name: result.result() for name, result in names.items()}


if len(sys.argv) != 4 or sys.argv[1] not in ("record", "check"):
    sys.exit(__doc__)
now = pictures(sys.argv[2])
if sys.argv[1] == "record":
    pathlib.Path(sys.argv[3]).write_text(json.dumps(now, indent=1))
    print(f"{len(now)} pictures")
    for name, hash_ in now.items():
        if hash_.startswith("exit"):
            print(f"refused: {name}: {hash_}")
else:
    before = json.loads(pathlib.Path(sys.argv[3]).read_text())
    other = sorted(name for name in before.keys() | now.keys() if before.get(name) != now.get(name))
    for name in other:
        print(f"{name}: {before.get(name)} is now {now.get(name)}")
    print(f"{len(before) - len(other)} of {len(before)} pictures are the same to the bit")
    sys.exit(1 if other else 0)
