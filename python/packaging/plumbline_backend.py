"""What pip asks (PEP 517) to make a wheel of the Python package: CMake builds and installs it, the rest is a zip file.

Nothing but the standard library is used and nothing is downloaded. The module stands on the shared libraries of the
machine that it was built on (packages.txt), so the wheel is for this machine and others of the same release. With
`--config-settings build-dir=FOLDER` a folder is used that was configured already; otherwise it is `build` beside
CMakeLists.txt. Errors are one line on standard error; pip shows it.
"""

import base64
import hashlib
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SUMMARY = "Holds a robot's model against measurements and names the physical effect that is missing"


def version():
    """The version that CMakeLists.txt states."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    found = re.search(r"^project\(plumbline VERSION ([0-9.]+)", text, re.MULTILINE)
    if found is None:
        sys.exit(f"{ROOT / 'CMakeLists.txt'}: found no version, expected project(plumbline VERSION ...)")
    return found.group(1)


def tag():
    """Interpreter, its binary interface and the platform: `cp311-cp311-linux_x86_64`."""
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{re.sub('[-.]', '_', sysconfig.get_platform())}"


def run(*command):
    """Runs a program; its output is pip's."""
    if subprocess.run([str(part) for part in command], check=False).returncode != 0:
        sys.exit("plumbline: found a failure of `" + " ".join(str(part) for part in command) + "`, expected it to work")


def installed(build, prefix):
    """The package as CMake installs it below a prefix."""
    if not (build / "CMakeCache.txt").exists():
        run("cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
            f"-DPython_EXECUTABLE={sys.executable}")
    run("cmake", "--build", build, "--target", "plumbline_python_package")
    run("cmake", "--install", build, "--component", "python", "--prefix", prefix, "--strip")
    package = next(pathlib.Path(prefix).glob("**/plumbline/__init__.py")).parent
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    if not (package / f"_plumbline{suffix}").exists():
        found = ", ".join(one.name for one in package.glob("_plumbline*.so"))
        sys.exit(f"{build}: found {found}, expected _plumbline{suffix}, for the Python that runs pip")
    return package


def metadata():
    """METADATA and WHEEL of a wheel, by name."""
    return {
        "METADATA": f"Metadata-Version: 2.1\nName: plumbline\nVersion: {version()}\nSummary: {SUMMARY}\n"
                    "License: Apache-2.0\nRequires-Python: >=3.9\nRequires-Dist: numpy\n",
        "WHEEL": f"Wheel-Version: 1.0\nGenerator: plumbline\nRoot-Is-Purelib: false\nTag: {tag()}\n",
    }


def write_wheel(path, files):
    """A zip file of name -> bytes with its RECORD (PEP 427); the same files give the same bytes."""
    record_name = f"plumbline-{version()}.dist-info/RECORD"
    lines = []
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, content in sorted(files.items()):
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            lines.append(f"{name},sha256={digest},{len(content)}\n")
            add(wheel, name, content)
        add(wheel, record_name, ("".join(lines) + f"{record_name},,\n").encode())


def add(wheel, name, content):
    """One member with a fixed date; readable, and a library executable."""
    member = zipfile.ZipInfo(name, (2000, 1, 1, 0, 0, 0))
    member.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
    member.compress_type = zipfile.ZIP_DEFLATED
    wheel.writestr(member, content)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """PEP 517: makes the wheel and returns its name."""
    del metadata_directory
    build = pathlib.Path((config_settings or {}).get("build-dir", ROOT / "build")).resolve()
    info = f"plumbline-{version()}.dist-info"
    with tempfile.TemporaryDirectory() as prefix:
        package = installed(build, prefix)
        files = {f"plumbline/{one.name}": one.read_bytes() for one in package.iterdir() if one.is_file()}
    files.update({f"{info}/{name}": text.encode() for name, text in metadata().items()})
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    name = f"plumbline-{version()}-{tag()}.whl"
    write_wheel(pathlib.Path(wheel_directory) / name, files)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """PEP 517 asks for it; the source is the project's folder."""
    raise NotImplementedError("a source distribution: use the project's folder")
