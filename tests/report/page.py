"""What a report page holds, read with the standard library's HTML parser."""

from __future__ import annotations

from html.parser import HTMLParser


class Page(HTMLParser):
    """Tags, attributes and text of a page."""

    def __init__(self, text: str) -> None:
        """Parse the text."""
        super().__init__()
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str, str]] = []
        self.texts: list[str] = []
        self._of: list[tuple[str, str]] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Keep the tag."""
        self.tags.append(tag)
        self.attributes += [(tag, name, value or "") for name, value in attrs]

    def handle_data(self, data: str) -> None:
        """Keep the text."""
        self.texts.append(data.strip())
        if data.strip():
            self._of.append((self.tags[-1], data.strip()))

    @property
    def headings(self) -> list[str]:
        """Titles of the parts of the page."""
        return [text for tag, text in self._of if tag == "h2"]

    @property
    def folds(self) -> list[str]:
        """What unfolds."""
        return [text for tag, text in self._of if tag == "summary"]

    def values(self, name: str) -> list[str]:
        """Values of an attribute, wherever it occurs."""
        return [value for _, attribute, value in self.attributes if attribute == name]
