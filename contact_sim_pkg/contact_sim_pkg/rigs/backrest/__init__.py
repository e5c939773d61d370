"""Back against a seat back: one mass or a shell with contact points."""
