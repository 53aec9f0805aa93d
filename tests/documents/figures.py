"""Figures that pages state and the code decides are the same in both.
Usage: figures.py, from the source tree's root."""
import pathlib
import re
import sys

# A page, its words with {} where the figure stands, and the constant that decides it, times what the figure counts.
FIGURES = [
    ("report.md", "Pixels that differ are examined {} at a time", "compare/against_reference.cpp", "examined_at_once"),
    ("report.md", "Pixels that differ are examined {} at a time", "compare/paths.cpp", "examined_at_once"),
    ("gates.md", "equal even so, and N is at most {}.", "compare/exact.cpp", "max_bound"),
    ("rounding.md", "wider by 1 + n / 8, at most {}fold", "rounding/positions.cpp", "most_reach"),
    ("gates.md", "the share that the scene allows, but at least {} pixels", "compare/against_reference.cpp", "always_allowed"),
    ("gates.md", "that they leave unexplained, if there are {} at most", "compare/against_reference.cpp", "few"),
    ("gates.md", "at more positions, as in gate B, if there are {} at most", "compare/paths.cpp", "few"),
    ("gates.md", "If one in {} samples at most is still unexplained", "compare/paths.cpp", "one_in"),
    ("gates.md", "At most {} / pixels samples of each pixel", "verify/verify.cpp", "most_kept"),
    ("report.md", "first hits of up to {} pixels that differ", "verify/page.cpp", "most_pixels"),
    ("report.md", "with more than {} rays and values", "core/ray_tree.hpp", "most"),
    ("gates.md", "more where `max_depth` is above {}, since", "compare/report.cpp", "usual_depth"),
    ("command-line.md", "samples more than {} times as bright", "render/brightness.hpp", "times_of_fireflies"),
    ("command-line.md", "`--spp N` is the most, {}", "cli/picture_options.hpp", "most_samples_by_default"),
    ("command-line.md", "on 127.0.0.1 and ::1; {}, and another", "cli/dev.cpp", "usual_port"),
    ("dev-loop.md", "not for scenes of more than {} primitives", "dev/render_server.cpp", "most_previewed"),
    ("performance.md", "in BVHs of up to {} primitives", "executors/trace_plan.cpp", "most_in_packets"),
    ("performance.md", "with vectors of 256 bits, from {} samples on", "executors/trace_plan.cpp", "least_samples_in_wavefront"),
    ("performance.md", "in scenes of up to {} primitives", "executors/trace_plan.cpp", "most_in_wavefront"),
    ("performance.md", "vectors of 512 bits** from {} samples", "executors/trace_plan.cpp", "least_samples_in_wide_vectors"),
    ("performance.md", "of more than {} primitives, they do", "executors/trace_plan.cpp", "most_in_wide_vectors"),
    ("tuning.md", "{} samples and more", "executors/trace_plan.cpp", "least_samples_in_wavefront"),
    ("tuning.md", "and up to {} primitives", "executors/trace_plan.cpp", "most_in_wavefront"),
    ("kernels.md", "where there are at most {} of each", "executors/scene_constants.cpp", "most_records"),
    ("kernels.md", "and at most {} are kept", "core/disk_cache.cpp", "most_entries"),
    ("implicit-surfaces.md", "When a scene is read, {} points", "executors/formula_check.cpp", "points"),
    ("scene-file.md", "| a file | {} |", "loader/scene_text.cpp", "most_bytes"),
    ("scene-file.md", "| a picture | {} pixels a side", "shards/part.cpp", "most_pixels_of_side"),
    ("scene-file.md", "pixels a side, {} in all", "loader/settings.cpp", "most_pixels"),
    ("scene-file.md", "| an image | {},", "image/coded_image.hpp", "most_coded_bytes"),
    ("scene-file.md", "| an image | 1 GiB, {} pixels", "image/coded_image.hpp", "most_coded_side"),
    ("scene-file.md", "| lights | {} |", "loader/scene_builder.cpp", "most_lights"),
    ("scene-file.md", "| includes | {} deep |", "loader/document.cpp", "deepest_include"),
    ("scene-file.md", "| groups in groups | {} deep", "loader/group_plan.cpp", "deepest"),
    ("scene-file.md", "since a key has at most {} parts", "reading/statements.hpp", "most_key_parts"),
    ("scene-file.md", "as they are kept | {} |", "loader/group_plan.cpp", "most_kept"),
    ("scene-file.md", "| a mesh file | {},", "importers/asset_files.hpp", "most_mesh_bytes"),
    ("scene-file.md", "| a mesh file | 4 GiB, {} triangles", "importers/mesh_builder.cpp", "most_triangles"),
    ("scene-file.md", "| the JSON of a glTF file | {} values", "importers/json_text.cpp", "most_values"),
    ("scene-file.md", "values, {} deep", "core/json_depth.hpp", "deepest_json"),
    ("scene-file.md", "| instances in a glTF file | {} |", "importers/gltf.cpp", "most_instances"),
    ("scene-file.md", "| decoded by Draco | {} numbers", "importers/gltf_draco.cpp", "most_values_a_byte"),
    ("scene-file.md", "vertices a byte of the file, and at least {} |", "importers/gltf_draco.cpp", "most_values_always"),
    ("scene-file.md", "| corners of a concave face | {};", "importers/polygon.hpp", "most_ear_corners"),
    ("scene-file.md", "| materials that light passes through | {} |", "loader/materials.cpp", "most_media"),
    ("security.md", "| text | {} |", "loader/formula_files.cpp", "most_bytes"),
    ("security.md", "only up to a depth of {}", "core/json_depth.hpp", "deepest_json"),
    ("gpus.md", "a tile has at most {} pixels", "executors/tile_size.cpp", "most_unexplored"),
    ("gpus.md", "their tiles have up to {} pixels", "executors/tile_size.hpp", "most_items"),
]
WORDS = {"a thousand": 1000, "eight": 8}
UNITS = {"KiB": 1 << 10, "MiB": 1 << 20, "GiB": 1 << 30}
RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")


def value_of(text):
    """2²⁰, 2^28, 16 384, 4 GiB, eight."""
    if text in WORDS:
        return WORDS[text]
    if power := re.fullmatch(r"2(?:\^(\d+)|([⁰¹²³⁴⁵⁶⁷⁸⁹]+))", text):
        return 1 << int(power[1] or power[2].translate(RAISED))
    number, _, unit = text.rpartition(" ") if text.endswith("iB") else (text, "", "")
    return int(number.replace(" ", "")) * UNITS.get(unit, 1)


def decided(source, name):
    text = (pathlib.Path("host") / source).read_text()
    value = re.search(rf"constexpr [\w:]+ (?:[^;]*, )?{name} = ([^;,]+)[;,]", text)
    if not value:
        return None
    plain = re.sub(r"\b\w+\{(\w+)\}", r"\1", value[1]).replace("'", "")
    return int(eval(plain, {"__builtins__": {}}))  # numbers and shifts


def words_of(page):
    """Its text, a space between words, links as they are read."""
    text = (pathlib.Path("docs") / page).read_text()
    return re.sub(r"\s+", " ", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text))


FIGURE = "(" + "|".join([*WORDS, r"2\^\d+", "2[⁰¹²³⁴⁵⁶⁷⁸⁹]+", r"\d[\d ]*\d (?:[KMG]iB)", r"\d (?:[KMG]iB)", r"\d[\d ]*\d|\d"]) + ")"
wrong = []
for page, words, source, name in FIGURES:
    pattern = re.escape(re.sub(r"\s+", " ", words)).replace(r"\{\}", FIGURE)
    found = re.findall(pattern, words_of(page))
    value = decided(source, name)
    if len(found) != 1:
        wrong.append(f"docs/{page} has {len(found)} times: {words}")
    elif value is None:
        wrong.append(f"host/{source} has no {name}")
    elif value_of(found[0]) != value:
        wrong.append(f"docs/{page}: {words.format(found[0])}; host/{source}: {name} is {value}")
print("\n".join(wrong) or f"{len(FIGURES)} figures are as the code has them")
sys.exit(1 if wrong else 0)
