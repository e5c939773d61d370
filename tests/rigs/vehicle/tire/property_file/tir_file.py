"""Property files of tires that nobody made, for tests."""

SI = {"LENGTH": "'meter'", "FORCE": "'newton'", "ANGLE": "'radians'", "MASS": "'kg'", "TIME": "'second'"}
SECTIONS = {
    "DIMENSION": {"UNLOADED_RADIUS": 0.316, "WIDTH": 0.205, "ASPECT_RATIO": 0.55, "RIM_RADIUS": 0.2032},
    "OPERATING_CONDITIONS": {"INFLPRES": 220000, "NOMPRES": 220000},
    "INERTIA": {"BELT_MASS": 7.0, "BELT_IYY": 0.6},
    "VERTICAL": {"FNOMIN": 4000, "VERTICAL_STIFFNESS": 220000},
    "STRUCTURAL": {"FREQ_LONG": 70.0, "DAMP_LONG": 0.045},
}


def text(units=None, **keys):
    """A file of a 205/55 R16; further keys replace those above, None leaves one out."""
    keys = dict(keys)
    lines = ["! made for a test", "[MDI_HEADER]", "FILE_TYPE = 'tir'", "$---units", "[UNITS]"]
    lines += [f"{name} = {unit}" for name, unit in (SI if units is None else units).items()]
    for section, values in SECTIONS.items():
        lines.append(f"[{section}]")
        given = {name: keys.pop(name, value) for name, value in values.items()}
        lines += [f"{name:<24} = {value!r:<12} $ {section}" for name, value in given.items() if value is not None]
    lines += ["[FURTHER]", *(f"{name} = {value}" for name, value in keys.items())]
    return "\n".join(lines) + "\n"


def write(folder, content=None, **keys):
    path = folder / "tire.tir"
    content = text(**keys) if content is None else content
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


MEASURED = """\
inflation (kPa),load (N),deflection (mm),stiffness (kN/m),length (mm),width (mm)
180,2000,12.0,176,94,126
180,4000,23.0,188,,
180,6000,33.4,197,184,147
240,2000,10.0,212,84,122
240,4000,19.2,225,,
240,6000,27.9,236,161,145
"""
"""A table of measurements that nobody made."""
