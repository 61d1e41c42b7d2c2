"""The line on the terminal that tells what a command is doing."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator


@contextlib.contextmanager
def progress(title: str, *, shown: bool) -> Iterator[Callable[[str], None]]:
    """Show on the terminal of what scene what is being done; nothing where there is no terminal.

    Args:
        title: of the scene.
        shown: whether there is a terminal, and words are wanted.

    Yields:
        What is told the work at hand.
    """
    if not shown:
        yield lambda _message: None
        return
    from rich.console import Console
    from rich.text import Text

    def line(message: str) -> Text:
        # Text, not str: a title may hold brackets, which rich would read as markup.
        return Text(f"{message} – {title}", no_wrap=True, overflow="ellipsis")

    console = Console(stderr=True)
    with console.status(line("libraries")) as status:
        console.show_cursor(True)  # A signal that ends the process would leave it hidden.
        yield lambda message: status.update(line(message))
