#!/usr/bin/env python3
"""Checks a package of the app: verify.py APK ABI...

Signatures, manifest, permissions, entries and their alignment, and in each library the size of its pages, its entry
points and what it asks of the system. Says everything that is wrong, and fails then.
"""

import re
import subprocess
import sys
import tempfile
import zipfile

PAGE = 16 << 10
LIBRARY = "libglimpse_android.so"
SYSTEM = {"libc.so", "libm.so", "libdl.so", "liblog.so", "libandroid.so"}
# Both ABIs: stated in android/README.md.
LARGEST = 40 << 20

MANIFEST = [
    r"package: name='dev\.glimpse\.android' versionCode='\d+'",
    r"sdkVersion:'28'",
    r"targetSdkVersion:'36'",
    r"application-label:'Glimpse'",
    r"launchable-activity: name='android\.app\.NativeActivity'",
    r"uses-feature: name='android\.hardware\.vulkan\.version'",
    r"uses-feature: name='android\.hardware\.vulkan\.level'",
    r"uses-feature: name='android\.hardware\.vulkan\.compute'",
]
# Of `aapt dump xmltree`: attributes that badging does not tell.
ATTRIBUTES = [
    r"android:extractNativeLibs\(\w+\)=\(type 0x12\)0x0\s",
    r"android:hasCode\(\w+\)=\(type 0x12\)0x0\s",
    r"android:exported\(\w+\)=\(type 0x12\)0xffffffff",
    r"android:enableOnBackInvokedCallback\(0x0101066c\)=\(type 0x12\)0x0\s",
    r'android:value\(\w+\)="glimpse_android"',
    r'"android\.intent\.action\.VIEW"',
    r'"android\.intent\.action\.SEND"',
    r'"model/gltf-binary"',
]


def output(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")
    return done.stdout


def signatures(apk):
    text = output("apksigner", "verify", "--min-sdk-version", "24", "--verbose", apk)
    for scheme in ("v2", "v3"):
        if not re.search(rf"Verified using {scheme} scheme.*: true", text):
            yield f"expected a signature of scheme {scheme}, found none"


def manifest(apk, abis):
    badging = output("aapt", "dump", "badging", apk)
    for pattern in MANIFEST:
        if not re.search(pattern, badging):
            yield f"manifest: expected {pattern}, found none"
    for permission in re.findall(r"^uses-permission.*$", badging, re.MULTILINE):
        yield f"manifest: expected no permission, found {permission}"
    native = sorted(re.findall(r"'([^']+)'", (re.search(r"^native-code:.*$", badging, re.M) or [""])[0]))
    if native != sorted(abis):
        yield f"manifest: expected code for {abis}, found {native}"
    tree = output("aapt", "dump", "xmltree", apk, "AndroidManifest.xml")
    for pattern in ATTRIBUTES:
        if not re.search(pattern, tree):
            yield f"manifest: expected {pattern}, found none"


def entries(apk, abis):
    with zipfile.ZipFile(apk) as archive, open(apk, "rb") as raw:
        names = [entry.filename for entry in archive.infolist()]
        for abi in abis:
            if f"lib/{abi}/{LIBRARY}" not in names:
                yield f"expected lib/{abi}/{LIBRARY}, found {[name for name in names if name.startswith('lib/')]}"
        if not any(name.startswith("assets/scenes/") and name.endswith(".glb") for name in names):
            yield "expected scenes below assets/scenes, found none"
        for entry in archive.infolist():
            raw.seek(entry.header_offset)
            header = raw.read(30)
            data = entry.header_offset + 30 + int.from_bytes(header[26:28], "little") + int.from_bytes(header[28:30], "little")
            stored = entry.compress_type == zipfile.ZIP_STORED
            if stored and data % PAGE:
                yield f"{entry.filename}: expected data at a multiple of {PAGE}, found {data}"
            if entry.filename.endswith(".so") and not stored:
                yield f"{entry.filename}: expected it stored, found it compressed"
            if entry.filename.endswith(".dex"):
                yield f"{entry.filename}: expected no Java code"
    with open(apk, "rb") as raw:
        size = raw.seek(0, 2)
    print(f"{apk}: {size / 1e6:.1f} MB")
    if size > LARGEST:
        yield f"expected at most {LARGEST} bytes, found {size}"


def library(apk, abi):
    with tempfile.NamedTemporaryFile(suffix=".so") as file, zipfile.ZipFile(apk) as archive:
        file.write(archive.read(f"lib/{abi}/{LIBRARY}"))
        file.flush()
        segments = [line.split() for line in output("readelf", "-lW", file.name).splitlines()]
        dynamic = output("readelf", "-dW", file.name)
        symbols = output("readelf", "--dyn-syms", "-W", file.name)
    for segment in segments:
        if segment[:1] == ["LOAD"] and int(segment[-1], 16) % PAGE:
            yield f"{abi}: expected segments for pages of {PAGE} bytes, found {segment[-1]}"
    if "TEXTREL" in dynamic:
        yield f"{abi}: expected no text relocations"
    needed = set(re.findall(r"NEEDED.*\[(.*)\]", dynamic))
    if not needed <= SYSTEM:
        yield f"{abi}: expected libraries of {sorted(SYSTEM)}, found {sorted(needed - SYSTEM)}"
    for entry_point in ("ANativeActivity_onCreate", "android_main"):
        if not re.search(rf"FUNC\s+GLOBAL\s+\w+\s+\d+\s+{entry_point}$", symbols, re.MULTILINE):
            yield f"{abi}: expected the entry point {entry_point}, found none"


def main():
    if len(sys.argv) < 3:
        raise SystemExit(__doc__)
    apk, abis = sys.argv[1], sys.argv[2:]
    wrong = [*signatures(apk), *manifest(apk, abis), *entries(apk, abis)]
    for abi in abis:
        wrong += library(apk, abi) if not wrong else []
    for line in wrong:
        print(f"{apk}: {line}", file=sys.stderr)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
