"""The progress line on the terminal, or below the cell of a notebook."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator


@contextlib.contextmanager
def progress(title: str, *, shown: bool) -> Iterator[Callable[[str], None]]:
    """Show the scene and the current step on the terminal or in a notebook; nothing where there is neither."""
    if not shown:
        yield lambda _message: None
        return
    from rich.console import Console
    from rich.text import Text

    def line(message: str) -> Text:
        # Text, not str: a title may hold brackets, which rich would read as markup.
        return Text(f"{message} – {title}", no_wrap=True, overflow="ellipsis")

    console = Console(stderr=True)
    if console.is_jupyter:
        # The status of rich would need ipywidgets there.
        from IPython.display import display

        shown_line = display({"text/plain": line("libraries").plain}, raw=True, display_id=True)
        yield lambda message: shown_line.update({"text/plain": line(message).plain}, raw=True)
        shown_line.update({"text/plain": line("solved").plain}, raw=True)
        return
    with console.status(line("libraries")) as status:
        console.show_cursor(True)  # A signal that ends the process would leave the cursor hidden.
        yield lambda message: status.update(line(message))
