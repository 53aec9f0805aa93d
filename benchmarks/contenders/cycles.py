import bpy, math, os, sys, time
from mathutils import Matrix

OUTPUT, SAMPLES, SEED = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.device = "CPU"
cycles.samples = int(SAMPLES)
cycles.seed = int(SEED)
# Render without bias, and with all bounces.
cycles.use_adaptive_sampling = False
cycles.use_denoising = False
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
cycles.blur_glossy = 0
cycles.light_sampling_threshold = 0
cycles.caustics_reflective = cycles.caustics_refractive = True
cycles.pixel_filter_type = "BOX"
cycles.filter_width = 1
image = scene.render.image_settings
image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGB", "32", "NONE"
scene.render.filepath = OUTPUT
scene.render.use_file_extension = False
scene.render.resolution_percentage = 100

# Blender's z axis points up. This rotation also makes the middle of its environment the middle of ours.
TURN = Matrix(((0, 0, -1, 0), (-1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 0, 1)))


def numbers(text, count):
    flat = [float(word) for word in text.split()]
    return [tuple(flat[i:i + count]) for i in range(0, len(flat), count)]


def corners(text):
    return [tuple(int(word) for word in line.split()) for line in text.splitlines() if line]


# Each part is (node, color, {other sockets: values}); the parts' light adds up.
def material(name, *parts):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    total = None
    for kind, color, values in parts:
        node = tree.nodes.new("ShaderNode" + kind)
        node.inputs["Color"].default_value = (*color, 1)
        for socket, value in values.items():
            node.inputs[socket].default_value = value
        if kind == "BsdfGlass":
            node.distribution = "SHARP"
        elif kind == "BsdfGlossy":
            node.distribution = "SHARP"
        if total:
            both = tree.nodes.new("ShaderNodeAddShader")
            tree.links.new(total, both.inputs[0])
            tree.links.new(node.outputs[0], both.inputs[1])
            total = both.outputs[0]
        else:
            total = node.outputs[0]
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    if total:
        tree.links.new(total, output.inputs["Surface"])
    return made


def mesh(vertices, faces, smooth=False, normals=None):
    made = bpy.data.meshes.new("mesh")
    made.from_pydata(vertices, [], faces)
    made.update()
    made.polygons.foreach_set("use_smooth", [smooth] * len(faces))
    if normals:
        made.use_auto_smooth = True
        made.normals_split_custom_set_from_vertices(normals)
    return made


def add(data, look, matrix=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))):
    if not data.materials:
        data.materials.append(look)
    item = bpy.data.objects.new("object", data)
    item.material_slots[0].link = "OBJECT"
    item.material_slots[0].material = look
    item.matrix_world = TURN @ Matrix(matrix)
    # By default Blender starts shadow rays away from smooth triangles, by a share of their size.
    item.cycles.shadow_terminator_geometry_offset = 0
    scene.collection.objects.link(item)


def sphere(rows=96, columns=192):
    vertices, faces = [(0, 1, 0)], []
    for row in range(1, rows):
        theta = math.pi * row / rows
        for column in range(columns):
            phi = 2 * math.pi * column / columns
            vertices.append((math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi)))
    vertices.append((0, -1, 0))
    at = lambda row, column: 1 + (row - 1) * columns + column % columns
    for column in range(columns):
        faces.append((0, at(1, column + 1), at(1, column)))
        faces.append((len(vertices) - 1, at(rows - 1, column), at(rows - 1, column + 1)))
        for row in range(1, rows - 1):
            faces.append((at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)))
    return mesh(vertices, faces, True, vertices)


def torus(minor, rows=192, columns=96):
    vertices, normals, faces = [], [], []
    for row in range(rows):
        phi = 2 * math.pi * row / rows
        for column in range(columns):
            theta = 2 * math.pi * column / columns
            out = (math.cos(theta) * math.cos(phi), math.sin(theta), math.cos(theta) * math.sin(phi))
            normals.append(out)
            vertices.append((math.cos(phi) + minor * out[0], minor * out[1], math.sin(phi) + minor * out[2]))
    at = lambda row, column: row % rows * columns + column % columns
    for row in range(rows):
        for column in range(columns):
            faces.append((at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)))
    return mesh(vertices, faces, True, normals)


def box():
    return mesh([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)],
                [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])


def disk(inner, columns=256):
    turn = [2 * math.pi * column / columns for column in range(columns)]
    rim = lambda r: [(r * math.cos(phi), 0, r * math.sin(phi)) for phi in turn]
    if inner == 0:
        return mesh(rim(1), [tuple(range(columns))])
    return mesh(rim(1) + rim(inner),
                [(i, (i + 1) % columns, columns + (i + 1) % columns, columns + i) for i in range(columns)])


def light(kind, energy, color, matrix, angle=0):
    data = bpy.data.lights.new("light", kind)
    data.energy = energy
    data.color = color
    data.use_nodes = False
    data.cycles.max_bounces = 1024
    if kind == "SUN":
        data.angle = angle
    else:
        data.shadow_soft_size = 0
    item = bpy.data.objects.new("light", data)
    item.matrix_world = TURN @ Matrix(matrix)
    scene.collection.objects.link(item)


def surroundings(color, turn=None):
    world = bpy.data.worlds.new("world")
    scene.world = world
    world.use_nodes = True
    tree = world.node_tree
    background = tree.nodes["Background"]
    background.inputs["Color"].default_value = (*color, 1)
    if turn is None:
        return
    picture = tree.nodes.new("ShaderNodeTexEnvironment")
    picture.image = bpy.data.images.load(os.path.join(os.path.dirname(os.path.abspath(__file__)), "environment.exr"))
    picture.image.colorspace_settings.name = "Linear"
    coordinates = tree.nodes.new("ShaderNodeTexCoord")
    turned = tree.nodes.new("ShaderNodeMapping")
    turned.inputs["Rotation"].default_value = (0, 0, -2 * math.pi * turn)
    tree.links.new(coordinates.outputs["Generated"], turned.inputs["Vector"])
    tree.links.new(turned.outputs["Vector"], picture.inputs["Vector"])
    tree.links.new(picture.outputs["Color"], background.inputs["Color"])


def camera(kind, angle_or_size, matrix):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "HORIZONTAL"
    data.clip_start, data.clip_end = 1e-6, 1e9
    data.type = kind
    if kind == "PERSP":
        data.angle = angle_or_size
    else:
        data.ortho_scale = angle_or_size
    item = bpy.data.objects.new("camera", data)
    item.matrix_world = TURN @ Matrix(matrix)
    scene.collection.objects.link(item)
    scene.camera = item


