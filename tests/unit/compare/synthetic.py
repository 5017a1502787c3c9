"""Small result folders in the formats of the programs. Synthetic: closed forms, no physics was computed."""

import base64
import contextlib
import json
import pathlib
import struct
import sys
import tempfile
import unittest
import zlib

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import sealed  # noqa: E402

MODULUS, STRENGTH, FRACTURE_ENERGY = 3.0e10, 3.0e6, 80.0
COLUMNS = {"strain": "1", "stress": "Pa", "psi_bulk": "J/m3", "psi_cohesive": "J/m3", "psi": "J/m3",
           "psi_undamaged": "J/m3", "damage": "1", "damage_path": "1", "damage_strength": "1",
           "damage_renormalised": "1", "opening": "m", "dissipation": "J/m3", "work": "J/m3"}


class InFolder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)


def bar_curve(size):
    """An elastic bar of length `size` with one linearly softening crack: strain = stress / E + w / size."""
    final_opening = 2 * FRACTURE_ENERGY / STRENGTH
    stress = np.concatenate([np.linspace(0, STRENGTH, 50), np.linspace(STRENGTH, 0, 400)[1:]])
    opening = np.concatenate([np.zeros(50), final_opening * np.linspace(0, 1, 400)[1:]])
    strain = stress / MODULUS + opening / size
    psi_bulk, psi_cohesive = stress**2 / (2 * MODULUS), stress * opening / (2 * size)
    undamaged = MODULUS * strain**2 / 2
    damage = 1 - np.divide(psi_bulk + psi_cohesive, undamaged, out=np.ones_like(undamaged),
                           where=undamaged > 0)
    damage = np.where(opening > 0, damage, 0.0)
    work = np.concatenate([[0], np.cumsum(0.5 * (stress[1:] + stress[:-1]) * np.diff(strain))])
    return {"strain": strain, "stress": stress, "psi_bulk": psi_bulk, "psi_cohesive": psi_cohesive,
            "psi": psi_bulk + psi_cohesive, "psi_undamaged": undamaged, "damage": damage,
            "damage_path": 1.02 * damage, "damage_strength": np.where(opening > 0, 1 - stress / STRENGTH, 0.0),
            "damage_renormalised": damage, "opening": opening,
            "dissipation": work - psi_bulk - psi_cohesive, "work": work}


def write_csv(path, columns):
    with open(path, "w", encoding="utf-8") as stream:
        print(",".join(columns), file=stream)
        for row in zip(*columns.values()):
            print(",".join(f"{value:.9g}" for value in row), file=stream)


def write_summary(folder, **entries):
    (folder / "summary.json").write_text(json.dumps(
        {"version": "synthetic", "input_file": "synthetic.prm", "wall_seconds": 1.5, "ranks": 1, "threads": 2,
         "peak_memory_bytes": 2**28} | entries), encoding="utf-8")
    (folder / "resolved.prm").write_text("# synthetic\nset Thickness = 127 mm\n", encoding="utf-8")


def change_summary(folder, **entries):
    path = folder / "summary.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | entries), encoding="utf-8")


def data_array(values, kind, name=None, components=1):
    """Inline compressed binary as deal.II writes it: four sizes, then one zlib block."""
    raw = np.ascontiguousarray(values).tobytes()
    packed = zlib.compress(raw)
    text = (base64.b64encode(struct.pack("<4I", 1, len(raw), len(raw), len(packed))) +
            base64.b64encode(packed)).decode()
    title = f' Name="{name}"' if name else ""
    return f'<DataArray type="{kind}"{title} NumberOfComponents="{components}" format="binary">{text}</DataArray>'


def write_cell(path, size, opening, strain=1e-4):
    """Two halves of a cell of 4 x 4 quadrilaterals, moved apart by `opening`."""
    line = size * np.linspace(0, 1, 5)
    halves = [line[:3], line[2:]]
    grid = np.concatenate([[(x, y, 0) for y in half for x in line] for half in halves])
    corner = np.array([[0, 1, 6, 5]]) + (np.arange(2)[:, None] * 5 + np.arange(4)).ravel()[:, None]
    corner = np.concatenate([corner, corner + 15])
    shift = np.zeros_like(grid)
    shift[15:, 1] = opening
    path.write_text(
        '<?xml version="1.0"?><VTKFile type="UnstructuredGrid" compressor="vtkZLibDataCompressor">'
        '<UnstructuredGrid><FieldData><DataArray type="Float64" Name="macroscopic_strain" NumberOfTuples="1" format="ascii">'
        f'{strain}</DataArray></FieldData><Piece NumberOfPoints="{len(grid)}" NumberOfCells="{len(corner)}"><Points>'
        + data_array(grid.astype("<f4"), "Float32", None, 3) + "</Points><Cells>"
        + data_array(corner.astype("<i4"), "Int32", "connectivity")
        + data_array((4 * np.arange(1, 1 + len(corner))).astype("<i4"), "Int32", "offsets")
        + data_array(np.full(len(corner), 9, "<u1"), "UInt8", "types") + "</Cells><PointData>"
        + data_array(shift.astype("<f4"), "Float32", "displacement", 3)
        + data_array(1e6 * grid[:, 0].astype("<f4"), "Float32", "stress_yy")
        + "</PointData></Piece></UnstructuredGrid></VTKFile>", encoding="utf-8")


def microcell(folder, sizes=(0.008, 0.016, 0.032)):
    folder.mkdir(parents=True)
    with h5py.File(folder / "damage_table.h5", "w") as file:
        file.attrs.update({"format": "spall damage table", "format_version": 1, "units": "SI",
                           "youngs_modulus": MODULUS, "poisson_ratio": 0.0, "tensile_strength": STRENGTH,
                           "fracture_energy": FRACTURE_ENERGY, "softening": "linear",
                           "crack_set": "synthetic bar", "boundary": "synthetic", "loading": "uniaxial strain",
                           "program": "microcell synthetic", "input_file": "synthetic.prm",
                           "created": "2000-01-01T00:00:00Z", "input": "set Key = value < 3"})
        for i, size in enumerate(sizes):
            group = file.create_group(f"curves/{i}")
            group.attrs["cell_size"] = size
            for name, values in bar_curve(size).items():
                group[name] = values
                group[name].attrs["unit"] = COLUMNS[name]
    sealed.seal(folder / "damage_table.h5")
    write_csv(folder / "curve.csv", bar_curve(sizes[1]))
    for i, (opening, strain) in enumerate(((1e-7, 1e-4), (5e-6, 3e-3))):
        write_cell(folder / f"fields_{i:03}.vtu", sizes[1], opening, strain)
    (folder / "fields.pvd").write_text(
        '<VTKFile type="Collection"><Collection><DataSet timestep="49" file="fields_000.vtu"/>'
        '<DataSet timestep="448" file="fields_001.vtu"/></Collection></VTKFile>', encoding="utf-8")
    write_summary(folder, program="microcell", cell_size=sizes[1], dofs=180, steps=448)
    return folder


def material(folder):
    folder.mkdir(parents=True)
    strain = np.linspace(0, 1e-3, 200)
    zero = np.zeros_like(strain)

    def pull(name, stress):
        write_csv(folder / f"{name}.csv", {"time": strain, "exx": strain} | dict.fromkeys(("eyy", "ezz"), zero) | {
            "sxx": stress} | dict.fromkeys(("syy", "szz", "sxy", "syz", "sxz"), zero) | {
            "pressure": -stress / 3, "tensile_damage": 1e3 * strain})

    pull("tension_afc", np.minimum(MODULUS * strain, 5.7e6))
    pull("tension_midm", np.interp(strain, [0, 1e-4, 6e-4, 1], [0, 3e6, 0, 0]))
    for name in ("hydrostat", "hydrostat_printed", "surface_slow", "surface_fast", "damage_strength", "damage_stiffness",
                 "damage_renormalised", "tension_printed"):
        pull(name, MODULUS * strain)
    for name in ("afc", "midm"):
        (folder / f"tension_{name}.csv.prm").write_text(
            "# material_point synthetic, 2000-01-01T00:00:00Z: synthetic.prm along path.csv; results are in SI units\n"
            f"set Law = {name}\n", encoding="utf-8")
    return folder


def history(folder, initial_velocity, final_velocity, mass, end, rigid):
    """A body that slows down smoothly; a quarter of the energy it loses stays kinetic in the points. A rigid
    body is booked apart from the points, a bar is the points."""
    time = np.linspace(0, end, 200)
    phase = np.clip(time / (0.8 * end), 0, 1)
    velocity = initial_velocity + (final_velocity - initial_velocity) * phase**2 * (3 - 2 * phase)
    projectile = mass * velocity**2 / 2
    lost = projectile[0] - projectile
    momentum = mass * (velocity[0] - velocity)
    columns = {"time": time, "projectile_position": np.concatenate(
        [[0], np.cumsum(0.5 * (velocity[1:] + velocity[:-1]) * np.diff(time))]),
        "projectile_velocity": velocity, "contact_force": -mass * np.gradient(velocity, time),
        "kinetic_energy": 0.25 * lost + (0 if rigid else projectile), "internal_energy": 0.6 * lost,
        "stabilization_energy": 0.03 * lost, "friction_work": 0.1 * lost, "contact_work": 0.02 * lost,
        "projectile_kinetic_energy": rigid * projectile, "total_energy": np.full_like(time, projectile[0]),
        "energy_error": 1e-4 * phase, "momentum": momentum - (0 if rigid else mass * initial_velocity),
        "impulse": momentum, "time_step": np.full_like(time, 1e-7), "shear_work": 0.5 * lost,
        "compression_work": 0.08 * lost, "tension_work": 0.02 * lost, "elastic_shear_energy": 0.01 * lost,
        "elastic_compression_energy": 0.02 * lost, "elastic_tension_energy": 0 * lost}
    write_csv(folder / "history.csv", columns)
    return columns


@contextlib.contextmanager
def changed_fields(path, mode="a"):
    """Opens all fields of a result as one file, then writes them as penetrate does: an index of links, the start, and a file for
    each frame, all sealed."""
    whole = path.with_name("fields.whole")
    with h5py.File(whole, mode) as file:
        yield file
    (path.parent / "fields").mkdir(exist_ok=True)
    with h5py.File(whole, "r") as file, h5py.File(path, "w") as index:
        index.attrs.update(dict(file.attrs))
        bodies = [name for name in file if name != "frames"]
        with h5py.File(path.parent / "fields" / "initial.h5", "w") as start:
            for body in bodies:
                file.copy(body, start)
                for name in file[body]:
                    index[f"{body}/{name}"] = h5py.ExternalLink("fields/initial.h5", f"/{body}/{name}")
        sealed.seal(path.parent / "fields" / "initial.h5")
        for name, frame in file["frames"].items():
            with h5py.File(path.parent / "fields" / f"{name}.h5", "w") as copy:
                copy.attrs.update(dict(frame.attrs))
                for body in frame:
                    frame.copy(body, copy)
            sealed.seal(path.parent / "fields" / f"{name}.h5")
            index[f"frames/{name}"] = h5py.ExternalLink(f"fields/{name}.h5", "/")
    sealed.seal(path)


def write_fields(path, main, initial, position, volume, fields, spacing, time):
    """fields.h5 of a quarter model with one deformable body, before and after."""
    with changed_fields(path, "w") as file:
        file.attrs.update({"main_body": main, "symmetry_planes": "x y", "spacing": spacing, "units": "SI"})
        file[f"{main}/initial_position"], file[f"{main}/volume"] = initial, volume
        for name, now, at in (("000", initial, 0.0), ("001", position, time)):
            file.create_group(f"frames/{name}").attrs["time"] = at
            group = file.create_group(f"frames/{name}/{main}")
            group["position"], group["velocity"] = now, (now - initial) / time
            group["pressure"] = np.zeros(len(now))
            for field, values in fields.items():
                group[field] = values.astype(np.float32) if at else np.zeros(len(now), np.float32)


def add_rigid(path, name, outline, origin, quaternion=(1.0, 0.0, 0.0, 0.0)):
    """A rigid body of revolution at one place in all frames."""
    with changed_fields(path) as file:
        file[f"{name}/outline"] = outline
        for frame in file["frames"].values():
            frame[f"{name}/position"] = np.zeros((4, 3))  # of its surface
            frame.attrs.update({f"{name}_{c}": x for c, x in zip("xyz", origin)})
            frame.attrs.update({f"{name}_q{c}": x for c, x in zip("wxyz", quaternion)})


def add_cloud(path, name, position, volume):
    """A further deformable body that does not move."""
    with changed_fields(path) as file:
        file[f"{name}/initial_position"], file[f"{name}/volume"] = position, volume
        for frame in file["frames"].values():
            frame[f"{name}/position"], frame[f"{name}/velocity"] = position, np.zeros_like(position)


def ogive(radius=0.0254, length=0.3556, caliber_radius_head=3.0):
    """Contour of a projectile from tip to tail: z and radius; the nose is an arc of S = 2 CRH R, tangent to the shaft."""
    arc, nose = 2 * caliber_radius_head * radius, radius * np.sqrt(4 * caliber_radius_head - 1)
    z = -np.linspace(0, nose, 40)
    r = np.maximum(0, radius - arc + np.sqrt(arc**2 - (nose + z) ** 2))
    return np.vstack([np.column_stack([z, r]), [[-length, radius], [-length, 0]]])


def write_inputs(folder, inputs):
    """resolved.prm with {'Section/Key': value} or longer keys."""
    text = "# synthetic\n"
    for key, value in inputs.items():
        *sections, name = key.split("/")
        text += "".join(f"subsection {section}\n" for section in sections) + f"set {name} = {value}\n" + "end\n" * len(sections)
    (folder / "resolved.prm").write_text(text, encoding="utf-8")


def write_craters(folder):
    """A front crater of 0.2 m and a square back crater with sides of 0.4 m, a quarter and half as deep as wide."""
    angle = np.radians(5 * np.arange(72) + 2.5)
    square = 0.2 / np.maximum(np.abs(np.cos(angle)), np.abs(np.sin(angle)))
    write_csv(folder / "craters.csv", {"angle": angle, "front_radius": np.full(72, 0.1), "back_radius": square})
    radius = np.linspace(0.001, 0.3, 100)
    write_csv(folder / "crater_profiles.csv", {"radius": radius, "front_depth": np.maximum(0, 0.05 - radius / 2),
                                               "back_depth": np.maximum(0, 0.1 - radius / 2)})


def slab(folder, exit_velocity=210.0, spacing=0.0318, thickness=0.127, radius=0.76, inputs=None):
    """The quarter x > 0, y > 0 of a disc on a lattice, holed and cracked along rays."""
    folder.mkdir(parents=True)
    layers = round(thickness / spacing)
    edge = thickness / layers
    line = edge * (0.5 + np.arange(int(radius / edge)))
    x, y, z = (a.ravel() for a in np.meshgrid(line, line, edge * (0.5 + np.arange(layers)), indexing="ij"))
    inside = np.hypot(x, y) < radius
    initial = np.column_stack([x, y, z])[inside]
    r, angle = np.hypot(initial[:, 0], initial[:, 1]), np.arctan2(initial[:, 1], initial[:, 0])
    hole, cone = np.exp(-r / 0.05), initial[:, 2] / thickness
    position = initial.copy()
    position[:, :2] *= (1 + 0.8 * 0.0254 * hole / r)[:, None]
    position[:, 2] += hole * (cone - 0.4) * 0.15
    fields = {"shear_damage": np.clip(2 * np.exp(-r / 0.04), 0, 1),
              "tensile_damage": np.clip(np.abs(np.cos(4 * angle)) ** 30 * np.exp(-r / 0.4) + np.exp(
                  -(r / (0.06 + 0.1 * cone)) ** 4), 0, 1),
              "plastic_strain": hole, "fragment": np.where(hole > 0.3, 1 + np.arange(len(hole)) // 3, 0)}
    write_fields(folder / "fields.h5", "slab", initial, position, np.full(len(initial), edge**3), fields, edge, 2e-3)
    add_rigid(folder / "fields.h5", "projectile", ogive(), (0, 0, thickness + 0.3556 + 0.01))
    history(folder, 313.0, exit_velocity, 2.34, 2e-3, True)
    write_craters(folder)
    (folder / "fragments.csv").write_text(
        "id,place,copies,mass,velocity_z\n0,remainder,1,500,0.1\n1,debris,4,0.05,40\n2,debris,4,0.01,90\n3,ejecta,2,0.01,-20\n",
        encoding="utf-8")
    write_summary(folder, program="penetrate", bodies="slab, projectile", main_body="slab", projectile="projectile",
                  target="slab", outcome="perforated", points=len(initial), steps=2000,
                  points_steps_per_second=4e6, thickness=thickness, diameter=1.52, impact_velocity=313.0,
                  exit_velocity=exit_velocity, time_of_exit=1.7e-3, perforated=True,
                  energy_balance_error=1e-4, momentum_balance_error=1e-6, front_crater_diameter=0.21,
                  back_crater_diameter=0.38, scheme="NSNI", spacing=edge, fragments=6, lone_points=4, lost_points=0,
                  **{f"{place}_{key}": value for place in ("remainder", "debris", "ejecta", "loose")
                     for key, value in (("fragments", 2), ("mass", 0.5), ("heaviest", 0.1), ("momentum", 3.0),
                                        ("kinetic_energy", 90.0))})
    if inputs:
        write_inputs(folder, inputs)
    return folder


def taylor(folder, ratio=0.705, anvil=False):
    """The quarter of a bar on concentric rings, bulged at the foot."""
    folder.mkdir(parents=True)
    length, radius, edge = 0.02347, 0.00381, 0.00038
    rings = [(edge * (i + 0.5), (np.arange(6 * (i + 1)) + 0.5) * np.pi / (12 * (i + 1))) for i in range(10)]
    plane = np.concatenate([np.column_stack([r * np.cos(a), r * np.sin(a)]) for r, a in rings])
    levels = edge * (0.5 + np.arange(int(length / edge)))
    initial = np.column_stack([np.tile(plane, (len(levels), 1)), np.repeat(levels, len(plane))])
    bulge = np.exp(-initial[:, 2] / 0.003)
    position = initial * np.column_stack([1 + 1.1 * bulge, 1 + 1.1 * bulge, np.full(len(initial), ratio)])
    write_fields(folder / "fields.h5", "bar", initial, position, np.full(len(initial), edge**3),
                 {"plastic_strain": 2 * bulge}, edge, 6e-5)
    history(folder, 373.0, 0.0, 2.9e-3, 6e-5, False)
    write_summary(folder, program="penetrate", bodies="bar, wall", main_body="bar", bar="bar", material="J2", points=len(initial),
                  steps=5000, impact_velocity=373.0, final_length_ratio=ratio, foot_diameter=0.0165,
                  max_plastic_strain=3.1, plastic_strain_95=1.6, energy_balance_error=2e-3)
    write_inputs(folder, {"bar/Model": "deformable", "bar/Height": "23.47 mm", "wall/Model": "rigid"} |
                 ({"anvil/Model": "deformable"} if anvil else {}))
    return folder


def references(folder):
    """Made-up measured values in the columns of the experiments' files."""
    folder.mkdir(parents=True)
    (folder / "perforation.csv").write_text(
        "# synthetic\nthickness_mm,nodes,impact_m_s,experiment_exit_m_s,nmap_exit_m_s,experiment_dv_percent,"
        "nmap_dv_percent,experiment_dke_percent,nmap_dke_percent\n127,1,313,200,190,36.1,39.3,59.2,63.2\n"
        "216,1,313,100,90,68.1,71.2,89.8,91.7\n", encoding="utf-8")
    (folder / "slab_verification.csv").write_text(
        "# synthetic\nset,opening,tensile_damage,failure_strain_floor,t_max_mpa,friction,thickness_mm,impact_m_s,exit_m_s,tolerance_m_s\n"
        "U,cracks,none,,2.5,0,127,313,240,4\nU,cut-off,none,,2.5,0,127,313,236,4\nG,cracks,exponential,,2.5,0.1,127,313,205,\n", encoding="utf-8")
    (folder / "taylor.csv").write_text(
        "# synthetic\nmaterial,impact_velocity_m_s,final_length_ratio_experiment,final_length_ratio_nmap,"
        "final_length_ratio_converged,foot_diameter_converged_mm\nAl 6061-T6,373,0.703,0.724,0.704,16.66\n",
        encoding="utf-8")
    return folder


def everything(folder):
    """One folder of each kind, in the order a user would name them."""
    return [microcell(folder / "microcell"), material(folder / "material"), slab(folder / "slab_127"),
            taylor(folder / "taylor_aluminium")]
