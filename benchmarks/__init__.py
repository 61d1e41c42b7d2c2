"""Error against seconds: this solver, equally expert scripts on other codes, and a bare lower bound."""
