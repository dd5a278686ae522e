#!/usr/bin/env python3
"""Whether links in pages lead somewhere: check_links.py

Every link of a page of this project names a file or folder that there is, and its anchor a heading of that page. Links
to the web are left alone. Fails with one line for each link that leads nowhere.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
NOT_OURS = {"build", "out"}
CODE = re.compile(r"^```.*?^```|`[^`\n]*`", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")
WEB = re.compile(r"[a-z]+:")


def pages():
    for path in sorted(ROOT.rglob("*.md")):
        parts = path.relative_to(ROOT).parts
        if parts[0] not in NOT_OURS and not any(part.startswith(".") for part in parts):
            yield path


def anchors(page):
    """Those of its headings, as GitHub makes them."""
    found = set()
    for heading in re.findall(r"^#+ +(.*)$", re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S), re.MULTILINE):
        shown = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
        slug = re.sub(r"[^\w\- ]", "", shown).replace(" ", "-")
        found.add(slug if slug not in found else slug + "-1")
    return found


def problem(page, link):
    """Why a link leads nowhere; None where it leads somewhere."""
    name, _, anchor = link.partition("#")
    target = (page.parent / name) if name else page
    if not target.exists():
        return "there is no such file"
    if anchor and target.suffix == ".md" and anchor not in anchors(target):
        return "the page has no such heading"
    return None


def main():
    failures = links = 0
    for page in pages():
        text = CODE.sub(lambda code: "\n" * code[0].count("\n"), page.read_text())
        for match in LINK.finditer(text):
            if WEB.match(match[1]):
                continue
            links += 1
            reason = problem(page, match[1])
            if reason:
                line = text.count("\n", 0, match.start()) + 1
                print(f"{page.relative_to(ROOT)}:{line}: {match[1]}: {reason}")
                failures += 1
    if links < 100:
        sys.exit(f"only {links} links were found")
    sys.exit(1 if failures else 0)


main()
