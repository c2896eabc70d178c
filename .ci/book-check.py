"""Checks a built book: book-check.py FOLDER

Each link and picture of each page leads somewhere, anchors included, and the search finds the
terms that a machinist looks for.
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

TERMS = [
    "tool length offset", "TCPC", "tilted work plane", "block delete", "R plane", "sub-spindle",
    "constant surface speed", "dog-leg", "G49", "G83", "work offset", "cutter compensation",
]


class Page(HTMLParser):
    """Links and anchors of a page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            if name in ("id", "name") and value:
                self.anchors.add(value)


def main():
    book = Path(sys.argv[1])
    # print.html has all pages in one, 404.html links from the root of a site.
    files = [path for path in book.rglob("*.html") if path.name not in ("print.html", "404.html", "toc.html")]
    files = [path for path in files if "playground" not in path.parts]
    pages = {path: Page(path) for path in files}
    wrong = []
    count = 0
    for path, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc or link.startswith("data:"):
                continue
            count += 1
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if target.is_dir():
                target = target / "index.html"
            if not target.exists():
                wrong.append(f"{path.relative_to(book)}: {link}")
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].anchors:
                wrong.append(f"{path.relative_to(book)}: {link}: no such heading")
    if wrong:
        sys.exit("links that lead nowhere:\n" + "\n".join(wrong))
    index = "".join(path.read_text(encoding="utf-8") for path in book.glob("searchindex*"))
    if not index:
        sys.exit("the book has no search index")
    missing = [term for term in TERMS if not re.search(re.escape(term), index, re.IGNORECASE)]
    if missing:
        sys.exit(f"the search does not find {', '.join(missing)}")
    print(f"{len(pages)} pages, {count} links, search over {len(index) // 1024} KiB: {book}")


main()
