"""The contact problem: impulses that satisfy the Signorini condition and Coulomb friction."""
