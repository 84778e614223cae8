"""Runs inside Blender 3.4: times Line Art and Freestyle on one mesh and camera.

blender -b -noaudio -P in_blender.py -- MESH.obj CAMERA.json OUT_FOLDER (lineart|freestyle)

Prints one JSON line that starts with "PEER ": seconds of each stage.
"""
import json
import math
import sys
import time

import addon_utils
import bpy
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Matrix, Vector

FURTHER_VIEWS = 4


def empty_scene():
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)


def load(path):
    start = time.perf_counter()
    bpy.ops.wm.obj_import(filepath=path, forward_axis='Y', up_axis='Z')
    mesh = bpy.context.selected_objects[0]
    mesh.matrix_world = Matrix.Identity(4)
    mesh.data.polygons.foreach_set('use_smooth', [True] * len(mesh.data.polygons))
    mesh.data.update()
    return mesh, time.perf_counter() - start


def add_camera(description):
    data = bpy.data.cameras.new('camera')
    data.sensor_fit = 'VERTICAL'
    data.angle = math.radians(description['fov_degrees'])
    data.clip_end = 1e6
    camera = bpy.data.objects.new('camera', data)
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y = description['size']
    render.resolution_percentage = 100
    aim(camera, description, 0)
    return camera


def aim(camera, description, degrees):
    """Places the camera, turned about the vertical axis through the point that it looks at."""
    look, up = Vector(description['look']), Vector(description['up'])
    offset = Matrix.Rotation(math.radians(degrees), 3, up) @ (Vector(description['eye']) - look)
    backward = offset.normalized()
    right = up.cross(backward).normalized()
    axes = Matrix((right, backward.cross(right), backward)).transposed()
    camera.matrix_world = Matrix.Translation(look + offset) @ axes.to_4x4()


def line_art(mesh):
    bpy.context.view_layer.objects.active = mesh
    bpy.ops.object.gpencil_add(type='LRT_OBJECT')
    pencil = bpy.context.object
    modifier = pencil.grease_pencil_modifiers[0]
    for name in ('use_intersection', 'use_crease', 'use_material', 'use_edge_mark', 'use_loose', 'use_light_contour', 'use_shadow'):
        if hasattr(modifier, name):
            setattr(modifier, name, False)
    modifier.use_contour = True
    return pencil


def evaluate():
    start = time.perf_counter()
    graph = bpy.context.evaluated_depsgraph_get()
    graph.update()
    return graph, time.perf_counter() - start


def strokes_of(pencil, graph, camera):
    """The strokes of the evaluated object in pixels: the exporter uses a wrong camera without a window."""
    scene = bpy.context.scene
    size = (scene.render.resolution_x, scene.render.resolution_y)
    result = []
    for layer in pencil.evaluated_get(graph).data.layers:
        for frame in layer.frames:
            for stroke in frame.strokes:
                points = [world_to_camera_view(scene, camera, pencil.matrix_world @ point.co) for point in stroke.points]
                result.append([(p.x * size[0], (1 - p.y) * size[1]) for p in points])
    return result, size


def write_svg(path, strokes, size):
    with open(path, 'w') as out:
        out.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size[0]} {size[1]}" fill="none" stroke="black" stroke-width="2">\n')
        out.write(f'<rect width="{size[0]}" height="{size[1]}" fill="white" stroke="none"/>\n')
        for stroke in strokes:
            out.write('<polyline points="' + ' '.join(f'{x:.2f},{y:.2f}' for x, y in stroke) + '"/>\n')
        out.write('</svg>\n')


def time_line_art(mesh, camera, description, folder):
    evaluate()
    pencil = line_art(mesh)
    graph, first = evaluate()
    strokes, size = strokes_of(pencil, graph, camera)
    write_svg(folder + '/lineart.svg', strokes, size)
    further = []
    for i in range(FURTHER_VIEWS):
        aim(camera, description, 15 * (i + 1))
        further.append(evaluate()[1])
    return {'first': first, 'further': further, 'strokes': len(strokes)}


def set_up_render():
    scene = bpy.context.scene
    scene.render.engine = 'CYCLES'
    scene.cycles.samples = 1
    scene.cycles.max_bounces = 0
    scene.cycles.use_denoising = False


def set_up_freestyle(suggestive):
    layer = bpy.context.scene.view_layers[0]
    layer.use_freestyle = True
    settings = layer.freestyle_settings
    lines = settings.linesets[0] if len(settings.linesets) else settings.linesets.new('lines')
    if lines.linestyle is None:
        lines.linestyle = bpy.data.linestyles.new('style')
    lines.select_silhouette = lines.select_border = lines.select_contour = True
    lines.select_crease = False
    lines.select_suggestive_contour = settings.use_suggestive_contours = suggestive


def render(path, lines):
    scene = bpy.context.scene
    scene.render.use_freestyle = lines
    scene.render.filepath = path
    start = time.perf_counter()
    bpy.ops.render.render(write_still=True)
    return time.perf_counter() - start


def time_freestyle(camera, description, folder):
    set_up_render()
    addon_utils.enable('render_freestyle_svg')
    bpy.context.scene.svg_export.use_svg_export = True
    bpy.context.scene.svg_export.mode = 'FRAME'
    times = {}
    for suggestive in (False, True):
        set_up_freestyle(suggestive)
        name = 'freestyle-suggestive' if suggestive else 'freestyle'
        without, with_lines = [], []
        for i in range(2):
            aim(camera, description, 15 * i)
            without.append(render(f'{folder}/plain', False))
            with_lines.append(render(f'{folder}/{name}-{i}-', True))
        times[name] = {'first': with_lines[0] - without[0], 'further': [with_lines[1] - without[1]], 'without_lines': without}
    return times


def main():
    mesh_path, camera_path, folder, what = sys.argv[sys.argv.index('--') + 1:]
    with open(camera_path) as file:
        description = json.load(file)
    empty_scene()
    mesh, read = load(mesh_path)
    camera = add_camera(description)
    result = {'read': read, 'triangles': len(mesh.data.polygons)}
    result[what] = time_line_art(mesh, camera, description, folder) if what == 'lineart' else time_freestyle(camera, description, folder)
    print('PEER ' + json.dumps(result), flush=True)


main()
