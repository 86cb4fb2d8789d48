# SPDX-License-Identifier: LGPL-2.1-or-later
"""Brings the .ts files beside this one up to date with the texts in the sources; translations are kept.

    /usr/bin/python3 resources/translations/update.py            # then fill in what is new, with Qt Linguist or an
    editor /usr/bin/python3 resources/translations/update.py --check    # fails when a text is missing or not translated

(Qt 5's lupdate does not read Python.)
"""

import ast
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
LANGUAGES = ("de", "fr")


def python_texts(path):
    """(context, text) of the calls of translate() and QT_TRANSLATE_NOOP() in a file."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Call) and len(node.args) == 2:
            name = node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")
            if name in ("translate", "QT_TRANSLATE_NOOP") and all(isinstance(a, ast.Constant) for a in node.args):
                yield node.args[0].value, node.args[1].value


def form_texts(path):
    """(context, text) of a Qt Designer file."""
    root = ET.parse(path).getroot()
    for node in root.iter("string"):
        if node.text and node.get("notr") != "true":
            yield root.find("class").text, node.text


def texts():
    """Every (context, text) once, sorted."""
    found = set()
    for folder in (ROOT / "gui", ROOT / "Mod"):
        for path in folder.rglob("*.py"):
            found.update(python_texts(path))
        for path in folder.rglob("*.ui"):
            found.update(form_texts(path))
    return sorted(found)


def read(path):
    """{(context, text): translation} of a .ts file."""
    known = {}
    if path.exists():
        for context in ET.parse(path).getroot().iter("context"):
            for message in context.iter("message"):
                known[context.findtext("name"), message.findtext("source")] = message.findtext("translation") or ""
    return known


def write(path, language, wanted, known):
    """Writes a .ts file with the texts that are wanted."""
    root = ET.Element("TS", version="2.1", language=language, sourcelanguage="en")
    contexts = {}
    for context, text in wanted:
        if context not in contexts:
            contexts[context] = ET.SubElement(root, "context")
            ET.SubElement(contexts[context], "name").text = context
        message = ET.SubElement(contexts[context], "message")
        ET.SubElement(message, "source").text = text
        translation = ET.SubElement(message, "translation")
        translation.text = known.get((context, text), "")
        if not translation.text:
            translation.set("type", "unfinished")
    ET.indent(root)
    path.write_text(
        '<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n' + ET.tostring(root, encoding="unicode") + "\n",
        encoding="utf-8",
    )


def main():
    wanted, missing = texts(), []
    for language in LANGUAGES:
        path = HERE / f"FemScalpel_{language}.ts"
        known = read(path)
        missing += [f"{language}: [{context}] {text}" for context, text in wanted if not known.get((context, text))]
        if "--check" not in sys.argv:
            write(path, language, wanted, known)
    print("\n".join(missing) or "all texts are translated")
    if missing and "--check" in sys.argv:
        sys.exit(1)


if __name__ == "__main__":
    main()
