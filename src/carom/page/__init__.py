"""The page to explore impacts: `carom explore`. It computes in the browser."""

from typing import Any

from carom.page.address import require

__all__ = ["Explorer", "explorer"]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"carom.page has no {name}", name=name)
    require()
    from carom.page import serving

    return getattr(serving, name)
