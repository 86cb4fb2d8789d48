#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks that the sources are fit for a release, and makes its files.

    resources/packaging/release.py --check          says what is not fit
    resources/packaging/release.py FOLDER [PYTHON...]
                                                    checks; then makes in FOLDER the source archive, the Debian package
                                                    for the release of Debian this runs on, a wheel for each Python
                                                    (default /usr/bin/python3), and SHA256SUMS

Fit means: all is committed; CMakeLists.txt, package.xml and the Python package have the same version; CHANGELOG.md has
an entry of it, with the date of package.xml, and none that is not released; the addresses of package.xml exist; and
tests/run.sh has passed at this commit.
"""

import argparse
import datetime
import hashlib
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
VERSIONS = {
    "CMakeLists.txt": r"project\(FemScalpel VERSION (\S+)",
    "package.xml": r"<version>(.*)</version>",
    "src/python/femscalpel/__init__.py": r'^__version__ = "(.*)"$',
}


def git(root, *arguments):
    """Output of a git command in `root`, without the newline at its end."""
    done = subprocess.run(["git", "-C", str(root), *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"release.py: git {arguments[0]} failed in {root}: {done.stderr.strip()}")
    return done.stdout.rstrip("\n")


def versions(root):
    """{file: the version it says, or None}."""
    found = {}
    for name, pattern in VERSIONS.items():
        match = re.search(pattern, (root / name).read_text(), re.MULTILINE)
        found[name] = match[1] if match else None
    return found


def changelog_problems(root, version):
    """What is not right in CHANGELOG.md."""
    heads = re.findall(r"^## \[(.*?)\](?: - (\S+))?", (root / "CHANGELOG.md").read_text(), re.MULTILINE)
    date = re.search(r"<date>(.*)</date>", (root / "package.xml").read_text())
    dated = dict(heads)
    if "Unreleased" in dated:
        yield f"CHANGELOG.md has an entry 'Unreleased': give it the version and the date, '## [{version}] - YYYY-MM-DD'"
    if version not in dated:
        yield f"CHANGELOG.md has no entry of version {version}"
        return
    try:
        datetime.date.fromisoformat(dated[version])
    except ValueError:
        yield f"CHANGELOG.md: version {version} has no date: write '## [{version}] - YYYY-MM-DD'"
        return
    if not date or date[1] != dated[version]:
        there = date[1] if date else "(none)"
        yield f"package.xml has the date {there}, CHANGELOG.md {dated[version]}: make them the same"


def test_problems(root):
    """Why the last run of the tests does not count. tests/run.sh notes the commit of which all tests passed."""
    note = root / "build" / "release" / "tests_passed_at"
    if not note.exists():
        return ["the tests did not run, or did not pass: run tests/run.sh"]
    if note.read_text().strip() != git(root, "rev-parse", "HEAD"):
        return ["the tests passed at another commit: run tests/run.sh"]
    return []


def problems(root):
    """Everything that keeps the sources in `root` from being released, a sentence each."""
    found = versions(root)
    changed = git(root, "status", "--porcelain")
    if changed:
        yield f"{len(changed.splitlines())} files are not committed, the first: {changed.splitlines()[0].strip()}"
    if len(set(found.values())) != 1 or None in found.values():
        yield "versions differ: " + ", ".join(f"{name} has {value}" for name, value in found.items())
    yield from changelog_problems(root, found["package.xml"])
    if re.search(r"https?://[^<]*\.invalid\b", (root / "package.xml").read_text()):
        yield "package.xml: its addresses end with .invalid: write where the repository is"
    yield from test_problems(root)


def source_archive(root, version, folder):
    """Packs what is committed; returns the file."""
    path = folder / f"femscalpel-{version}.tar.gz"
    git(root, "archive", f"--prefix=femscalpel-{version}/", "-o", str(path), "HEAD")
    return path


def made_by(root, script, arguments, folder):
    """Copies what a script of this folder makes, by the paths it prints; returns the files."""
    done = subprocess.run(
        ["sh", str(root / "resources" / "packaging" / script), *arguments],
        stdout=subprocess.PIPE,
        text=True,
        check=False,
    )
    if done.returncode:
        raise SystemExit(f"release.py: {script} failed, see above")
    return [Path(shutil.copy(path, folder)) for path in done.stdout.splitlines()]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=Path, help="where the files go; made if it is not there")
    parser.add_argument("python", nargs="*", help="Pythons to make wheels for (/usr/bin/python3)")
    parser.add_argument("--check", action="store_true", help="only say what is not fit")
    arguments = parser.parse_args()
    if arguments.check == bool(arguments.folder):
        parser.error("give a folder for the files, or --check")
    found = list(problems(ROOT))
    for problem in found:
        print(f"release.py: {problem}", file=sys.stderr)
    if found:
        return 1
    version = versions(ROOT)["package.xml"]
    print(f"version {version} is fit for a release")
    if arguments.check:
        return 0
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    files = [source_archive(ROOT, version, folder)]
    files += made_by(ROOT, "deb.sh", [], folder) + made_by(ROOT, "wheel.sh", arguments.python, folder)
    sums = "".join(f"{hashlib.sha256(f.read_bytes()).hexdigest()}  {f.name}\n" for f in files)
    (folder / "SHA256SUMS").write_text(sums)
    for path in [*files, folder / "SHA256SUMS"]:
        print(f"{path} ({path.stat().st_size / 1e6:.1f} MB)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
