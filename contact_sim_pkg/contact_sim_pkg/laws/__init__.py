"""Force laws of a contact point: elastic, foam, Hunt-Crossley, general, Coulomb; restitution."""

from contact_sim_pkg.public import on_use

_PARAMETERS = (
    "Contact", "FoamElastic", "FoamHysteresis", "Friction", "GeneralDissipative", "NormalDissipative", "NormalElastic",
    "TabulatedElastic",
)  # fmt: skip
_OF_ELASTIC_LAW = ("approach_of_force", "elastic_energy", "elastic_force", "elastic_stiffness")

__getattr__ = on_use(
    __name__,
    {
        **{name: f"{__name__}.parameters:{name}" for name in _PARAMETERS},
        **{name: f"{__name__}.elastic_law:{name}" for name in _OF_ELASTIC_LAW},
    },
)
