"""Tests of the pages: links and pictures hold, each says whom it is for. With a test's name as argument only that one is run."""

import re
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent
FENCE = re.compile(r"^ *```.*?^ *```", re.M | re.S)
LINK = re.compile(r"\]\(([^)\s]+)\)")
FILE = re.compile(r"\b(?:cases|scripts|tests|cuda|host)/[\w./-]+\.(?:toml|stl|csv|json|md|hpp|cpp|cu)\b")


def pages(top):
    return sorted(page for page in top.rglob("*.md")
                  if not {"build", "runs"} & set(page.relative_to(top).parts) and "/." not in f"/{page.relative_to(top)}")


def prose(page):
    """The text without blocks and pieces of code."""
    return re.sub(r"`[^`\n]*`", "", FENCE.sub("", page.read_text()))


def anchors(page):
    """What GitHub makes of the headings."""
    found = {}
    for heading in re.findall(r"^#+ (.*)$", FENCE.sub("", page.read_text()), re.M):
        slug = re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")
        found[slug] = found.get(slug, -1) + 1
    return {f"{slug}-{k}" if k else slug for slug, last in found.items() for k in range(last + 1)}


def broken_links(top):
    broken = []
    for page in pages(top):
        for link in LINK.findall(prose(page)):
            path, _, anchor = link.partition("#")
            target = page.parent / path if path else page
            if re.match(r"[a-z]+:", link):
                continue
            if not target.exists() or (anchor and anchor not in anchors(target)):
                broken.append(f"{page.relative_to(top)}: {link}")
    return broken


def missing_files(top):
    """Of the project's files that pages name, those that are not there."""
    return [f"{page.relative_to(top)}: {name}" for page in pages(top) for name in FILE.findall(page.read_text())
            if not (top / name).exists() and not (page.parent / name).exists() and "NAME" not in name]


def without_reader(top):
    return [str(page.relative_to(top)) for page in pages(top)
            if not re.match(r"# [^\n]+\n\nFor (a|an|who|whom|whoever) ", page.read_text())]


class Pages(unittest.TestCase):
    def project(self, **texts):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        for name, text in texts.items():
            (Path(folder.name) / f"{name}.md").write_text(text)
        return Path(folder.name)

    def test_links_and_pictures_are_there(self):
        self.assertEqual(broken_links(PROJECT), [])

    def test_a_broken_link_is_found(self):
        top = self.project(a="[b](b.md) [b](b.md#two-words-10%) ![c](c.png) [d](#d) `[e](e.md)`\n```\n[f](f.md)\n```\n",
                           b="# Two words: (10)\n# G\n# G\n[g](#g-1) [h](#two-words-10) [i](https://x.y/z.md) [j](#g-2)\n")
        self.assertEqual(broken_links(top), ["a.md: b.md#two-words-10%", "a.md: c.png", "a.md: #d", "b.md: #g-2"])

    def test_files_that_pages_name_are_there(self):
        self.assertEqual(missing_files(PROJECT), [])

    def test_a_file_that_is_gone_is_found(self):
        self.assertEqual(missing_files(self.project(a="`cases/gone.toml` and cases/NAME.toml")), ["a.md: cases/gone.toml"])

    def test_each_page_opens_with_whom_it_is_for(self):
        self.assertEqual(without_reader(PROJECT), [])
        self.assertEqual(without_reader(self.project(a="# A\n\nFor a user.\n", b="# B\n\nText.\n")), ["b.md"])

    def test_readme_is_short_and_names_every_page(self):
        text = (PROJECT / "README.md").read_text()
        self.assertLessEqual(len(text.splitlines()), 250)
        for page in pages(PROJECT):
            name = str(page.relative_to(PROJECT))
            self.assertTrue(name == "README.md" or f"]({name}" in text, name)


if __name__ == "__main__":
    unittest.main()
