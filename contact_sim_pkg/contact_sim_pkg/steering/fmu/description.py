"""`modelDescription.xml` of a unit of FMI 2.0."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from contact_sim_pkg import __version__
from contact_sim_pkg.scene.resolved_scene import ResolvedScene
from contact_sim_pkg.steering.fmu.variables import Variable

__all__ = ["SWITCH", "base_units", "described", "model_identifier"]

SWITCH = "platform.vibration.from_inputs"
"""Boolean parameter: whether the inputs take the place of the scene's own vibration."""
SWITCH_TEXT = "whether the inputs take the place of the scene's own vibration"
BASE: dict[str, dict[str, int]] = {
    "1": {}, "m": {"m": 1}, "s": {"s": 1}, "kg": {"kg": 1}, "K": {"K": 1}, "rad": {"rad": 1}, "Hz": {"s": -1},
    "N": {"kg": 1, "m": 1, "s": -2}, "Pa": {"kg": 1, "m": -1, "s": -2}, "J": {"kg": 1, "m": 2, "s": -2},
    "W": {"kg": 1, "m": 2, "s": -3},
}  # fmt: skip
"""SI units that columns have, by their exponents of base units."""
FACTOR = r"([A-Za-z1]+)(?:\^(\d+))?"


def described(scene: ResolvedScene, guid: str, outputs: Sequence[Variable], inputs: Sequence[Variable]) -> bytes:
    """The file of a scene's unit, whose variables have the value references of their order, inputs behind outputs.

    The outputs depend on no input of the same instant: they are those of the end of a step.
    """
    root = Element(
        "fmiModelDescription", fmiVersion="2.0", modelName=scene.name, guid=guid, variableNamingConvention="structured",
        description=str(scene.data.get("description") or scene.name), version=__version__,
        generationTool=f"Contact Bench {__version__}",
    )  # fmt: skip
    SubElement(
        root, "CoSimulation", modelIdentifier=model_identifier(scene.name), needsExecutionTool="true",
        canHandleVariableCommunicationStepSize="false", canInterpolateInputs="true" if inputs else "false",
        canGetAndSetFMUstate="true", canSerializeFMUstate="true",
    )  # fmt: skip
    _add_units(SubElement(root, "UnitDefinitions"), (*outputs, *inputs))
    categories = SubElement(root, "LogCategories")
    for category in ("logStatusError", "logStatusDiscard"):
        SubElement(categories, "Category", name=category)
    length = repr(scene.block_length)
    SubElement(root, "DefaultExperiment", startTime="0.0", stopTime=repr(scene.duration), stepSize=length)
    _add_variables(SubElement(root, "ModelVariables"), outputs, inputs)
    structure = SubElement(root, "ModelStructure")
    for name in ("Outputs", "InitialUnknowns"):
        unknowns = SubElement(structure, name)
        for place in range(len(outputs)):
            SubElement(unknowns, "Unknown", index=str(place + 1), dependencies="")
    ElementTree.indent(root)
    text: bytes = ElementTree.tostring(root, "utf-8", xml_declaration=True)
    return text


def model_identifier(name: str) -> str:
    """The name of a scene as one of C, which its library has too."""
    plain = re.sub(r"[^A-Za-z0-9_]", "_", name)
    return f"_{plain}" if plain[:1].isdigit() else plain


def base_units(unit: str) -> dict[str, int] | None:
    """Exponents of kg, m, s, K and rad of a unit such as ``m^2/s^3`` or ``N m``, in which a stroke divides by one factor;
    None for one that is none of the SI.
    """
    exponents: Counter[str] = Counter()
    if not re.fullmatch(rf"{FACTOR}(?:[ /]{FACTOR})*", unit):
        return None
    for sign, name, power in re.findall(rf"(^|[ /]){FACTOR}", unit):
        if name not in BASE:
            return None
        for base, exponent in BASE[name].items():
            exponents[base] += exponent * int(power or 1) * (-1 if sign == "/" else 1)
    return {base: exponent for base, exponent in exponents.items() if exponent}


def _add_units(definitions: Element, variables: Sequence[Variable]) -> None:
    for name in sorted({each.unit for each in variables if each.unit}):
        unit = SubElement(definitions, "Unit", name=name)
        found = {} if name == "%" else base_units(name)
        if found is not None:
            factor = {"factor": "0.01"} if name == "%" else {}
            SubElement(unit, "BaseUnit", {base: str(exponent) for base, exponent in found.items()} | factor)


def _add_variables(variables: Element, outputs: Sequence[Variable], inputs: Sequence[Variable]) -> None:
    """Outputs first: their value references are their places among them."""
    for place, each in enumerate((*outputs, *inputs)):
        is_input = place >= len(outputs)
        scalar = SubElement(
            variables, "ScalarVariable", name=each.name, valueReference=str(place), description=each.text,
            causality="input" if is_input else "output",
        )  # fmt: skip
        real = SubElement(scalar, "Real")
        if each.unit:
            real.set("unit", each.unit)
        if is_input:
            real.set("start", "0.0")
    if inputs:
        scalar = SubElement(
            variables, "ScalarVariable", name=SWITCH, valueReference="0", description=SWITCH_TEXT, causality="parameter",
            variability="fixed",
        )  # fmt: skip
        SubElement(scalar, "Boolean", start="false")
