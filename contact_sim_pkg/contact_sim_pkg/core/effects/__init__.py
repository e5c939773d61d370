"""One physical effect a file: its neutral value, its force, its stored energy."""
