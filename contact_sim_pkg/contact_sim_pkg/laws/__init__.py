"""Force laws of a contact point: elastic, foam, Hunt-Crossley, general, Coulomb; restitution."""
