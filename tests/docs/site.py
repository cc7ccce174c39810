"""Whatever the pages of the site refer to on this disk is there: pages, pictures, scripts, anchors of pages.

usage: site.py FOLDER
"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.names, self.links = set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("id", "name") and value:
                self.names.add(value)
            elif key in ("href", "src") and value:
                self.links.append(value)


def missing(pages, path, link):
    """What a link of a page points to, if that is not there."""
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    target = path.parent / unquote(parts.path) if parts.path else path
    if not target.exists():
        return link
    made_here = target in pages and target.name != "studio.html"
    return link if made_here and parts.fragment and unquote(parts.fragment) not in pages[target].names else None


def main(folder):
    pages = {path: Page(path) for path in sorted(Path(folder).glob("*.html"))}
    wrong = [f"{path.name}: {link}" for path, page in pages.items() for link in page.links if missing(pages, path, link)]
    print("\n".join(wrong) or f"{len(pages)} pages, {sum(len(p.links) for p in pages.values())} links")
    return 1 if wrong or not pages else 0


sys.exit(main(sys.argv[1]))
