# SPDX-License-Identifier: LGPL-2.1-or-later
"""The release script refuses sources that are not fit for a release, each for its reason."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "resources" / "packaging"))
import release  # noqa: E402

pytestmark = pytest.mark.skipif(not shutil.which("git"), reason="no git here")
DATE = "2026-12-24"


def commit(root):
    identity = ["-c", "user.name=A", "-c", "user.email=a@example.org"]
    for arguments in (["add", "-A"], [*identity, "commit", "-qm", "all"]):
        subprocess.run(["git", "-C", str(root), *arguments], check=True)
    head = subprocess.run(["git", "-C", str(root), "rev-parse", "HEAD"], capture_output=True, check=True).stdout
    (root / "build" / "release").mkdir(parents=True, exist_ok=True)
    (root / "build" / "release" / "tests_passed_at").write_bytes(head)


@pytest.fixture
def sources(tmp_path):
    """A repository that is fit for a release of version 1.2.3."""
    for name in release.VERSIONS:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    old = release.versions(tmp_path)["package.xml"]
    for name in release.VERSIONS:
        text = (tmp_path / name).read_text().replace(old, "1.2.3").replace("femscalpel.invalid", "example.org")
        (tmp_path / name).write_text(text)
    package = tmp_path / "package.xml"
    head, _, tail = package.read_text().partition("<date>")
    package.write_text(head + f"<date>{DATE}" + tail[len(DATE) :])
    (tmp_path / "CHANGELOG.md").write_text(f"# Changelog\n\n## [1.2.3] - {DATE}\n")
    (tmp_path / ".gitignore").write_text("build/\n")
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    commit(tmp_path)
    return tmp_path


def replace(path, old, new):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def test_fit(sources):
    assert list(release.problems(sources)) == []


@pytest.mark.parametrize(
    ("name", "old", "new", "reason"),
    [
        ("CMakeLists.txt", "VERSION 1.2.3", "VERSION 1.2.4", "versions differ: CMakeLists.txt has 1.2.4, package.xml"),
        ("src/python/femscalpel/__init__.py", "__version__ =", "version =", "__init__.py has None"),
        ("CHANGELOG.md", "## [1.2.3]", "## [Unreleased]\n\n## [1.2.3]", "has an entry 'Unreleased'"),
        ("CHANGELOG.md", "[1.2.3]", "[1.2.2]", "no entry of version 1.2.3"),
        ("CHANGELOG.md", f" - {DATE}", " - soon", "version 1.2.3 has no date"),
        ("CHANGELOG.md", DATE, "2026-12-23", f"package.xml has the date {DATE}, CHANGELOG.md 2026-12-23"),
        ("package.xml", "https://example.org/", "https://femscalpel.invalid/", "addresses end with .invalid"),
    ],
)
def test_not_fit(sources, name, old, new, reason):
    replace(sources / name, old, new)
    commit(sources)
    (problem,) = release.problems(sources)
    assert reason in problem


def test_not_committed(sources):
    (sources / "new.txt").touch()
    (problem,) = release.problems(sources)
    assert problem == "1 files are not committed, the first: ?? new.txt"


def test_tests_must_have_passed_at_this_commit(sources):
    note = sources / "build" / "release" / "tests_passed_at"
    note.write_text("0" * 40 + "\n")
    assert list(release.problems(sources)) == ["the tests passed at another commit: run tests/run.sh"]
    note.unlink()
    assert list(release.problems(sources)) == ["the tests did not run, or did not pass: run tests/run.sh"]


def test_the_archive_has_what_is_committed(sources, tmp_path_factory):
    path = release.source_archive(sources, "1.2.3", tmp_path_factory.mktemp("out"))
    names = subprocess.run(["tar", "-tzf", str(path)], capture_output=True, text=True, check=True).stdout.split()
    assert "femscalpel-1.2.3/package.xml" in names and not any("/build/" in name for name in names)


def test_files_that_scripts_make_are_copied(sources, tmp_path):
    """Each prints the paths of what it made."""
    folder = sources / "resources" / "packaging"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "make.sh").write_text('for name; do echo made >"$0.$name"; echo "$0.$name"; done\n')
    (tmp_path / "out").mkdir()
    made = release.made_by(sources, "make.sh", ["a b", "c"], tmp_path / "out")
    assert [path.name for path in made] == ["make.sh.a b", "make.sh.c"] and all(path.exists() for path in made)
    assert {path.parent for path in made} == {tmp_path / "out"}
    (folder / "make.sh").write_text("exit 3\n")
    with pytest.raises(SystemExit, match="make.sh failed, see above"):
        release.made_by(sources, "make.sh", [], tmp_path / "out")


def test_wheels_have_the_version_of_the_sources():
    tomllib = pytest.importorskip("tomllib")
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())
    version = settings["tool"]["scikit-build"]["metadata"]["version"]
    found = release.re.search(version["regex"], (ROOT / version["input"]).read_text())
    assert found["value"] == release.versions(ROOT)["package.xml"]
    pins = dict(
        line.split("==") for line in (ROOT / "resources" / "pypi-packages.txt").read_text().split("\n")[1:] if line
    )
    for needed in settings["build-system"]["requires"]:
        name, least = needed.split(">=")
        assert [int(n) for n in pins[name].split(".")] >= [int(n) for n in least.split(".")]
