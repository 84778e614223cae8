"""Renders meshes in Blender (Debian package blender, 3.4), with normal maps where they have one.

usage: blender -b -P blender_normal_map.py -- OBJ,PNG,object|tangent,PICTURE ...     (PNG may be empty)
"""
import sys

import bpy
import mathutils


def stage(scene):
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    scene.render.engine = 'CYCLES'
    scene.cycles.samples = 64
    scene.cycles.max_bounces = 0
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = 420, 380
    scene.view_settings.view_transform = 'Standard'
    scene.world.use_nodes = True
    scene.world.node_tree.nodes['Background'].inputs[0].default_value = (0.08, 0.08, 0.08, 1)
    camera = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
    away = mathutils.Vector((0.9, -3.2, 1.3))
    camera.location = away + mathutils.Vector((0.2, 0, 0.75))
    camera.rotation_euler = (-away).to_track_quat('-Z', 'Y').to_euler()
    sun = bpy.data.objects.new('sun', bpy.data.lights.new('sun', 'SUN'))
    sun.data.energy, sun.data.angle, sun.rotation_euler = 2.2, 0, (0.9, 0.1, -0.7)
    for thing in (camera, sun):
        scene.collection.objects.link(thing)
    scene.camera = camera


def material(png, space):
    made = bpy.data.materials.new('clay')
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    shader = nodes['Principled BSDF']
    shader.inputs['Base Color'].default_value = (0.5, 0.42, 0.35, 1)
    shader.inputs['Roughness'].default_value = 0.3
    if png:
        texture, normal = nodes.new('ShaderNodeTexImage'), nodes.new('ShaderNodeNormalMap')
        texture.image = bpy.data.images.load(png)
        texture.image.colorspace_settings.name = 'Non-Color'
        normal.space = space.upper()
        links.new(texture.outputs['Color'], normal.inputs['Color'])
        links.new(normal.outputs['Normal'], shader.inputs['Normal'])
    return made


def render(scene, obj, png, space, picture):
    before = set(bpy.data.objects)
    bpy.ops.wm.obj_import(filepath=obj)
    for thing in set(bpy.data.objects) - before:
        thing.data.materials.clear()
        thing.data.materials.append(material(png, space))
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)
    for thing in set(bpy.data.objects) - before:
        bpy.data.objects.remove(thing)


stage(bpy.context.scene)
for argument in sys.argv[sys.argv.index('--') + 1:]:
    render(bpy.context.scene, *argument.split(','))
