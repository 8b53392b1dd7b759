# SPDX-License-Identifier: Apache-2.0
"""blender --background --factory-startup --python-exit-code 3 --python blender_bake.py -- MODEL OUT.glb

A light copy of a scan as a script for Blender makes it: 3,000 triangles by the decimate modifier, smart UV project, colours and
normals baked by Cycles into maps of 256 x 256 texels, exported with JPEG maps. Written for Debian's Blender 3.4.
"""
import sys

import bpy
import numpy

TRIANGLES, TEXELS, SAMPLES = 3000, 256, 4
REACH = 0.02  # of the longest side: how far rays start outside, and half of how far they go
IMPORTERS = {'ply': bpy.ops.import_mesh.ply, 'stl': bpy.ops.import_mesh.stl, 'obj': bpy.ops.wm.obj_import, 'glb': bpy.ops.import_scene.gltf}


def select(*objects):
    bpy.ops.object.select_all(action='DESELECT')
    for each in objects:
        each.select_set(True)
    bpy.context.view_layer.objects.active = objects[-1]


def read(path):
    """The scan as one object."""
    numpy.bool = bool  # the importer for glTF asks for a name that newer numpy has dropped
    bpy.ops.wm.read_factory_settings(use_empty=True)
    IMPORTERS[path.rsplit('.', 1)[-1]](filepath=path)
    meshes = [each for each in bpy.context.scene.objects if each.type == 'MESH']
    select(*meshes)
    bpy.ops.object.join()
    return bpy.context.view_layer.objects.active


def show_colours(scan):
    """Whether it has any; those of vertices get a material that shows them."""
    if scan.data.materials or not scan.data.color_attributes:
        return bool(scan.data.materials)
    material = bpy.data.materials.new('scan')
    material.use_nodes = True
    colours = material.node_tree.nodes.new('ShaderNodeVertexColor')
    colours.layer_name = scan.data.color_attributes[0].name
    material.node_tree.links.new(colours.outputs['Color'], material.node_tree.nodes['Principled BSDF'].inputs['Base Color'])
    scan.data.materials.append(material)
    return True


def lighten(scan):
    """A decimated copy with an atlas and a material of its own."""
    light = scan.copy()
    light.data = scan.data.copy()
    bpy.context.collection.objects.link(light)
    select(light)
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.mesh.select_all(action='SELECT')
    bpy.ops.mesh.remove_doubles(threshold=1e-6 * max(scan.dimensions))  # seams would tear
    bpy.ops.object.mode_set(mode='OBJECT')
    modifier = light.modifiers.new('decimate', 'DECIMATE')
    modifier.ratio = min(1, TRIANGLES / len(light.data.polygons))
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    light.data.materials.clear()
    while light.data.uv_layers:
        light.data.uv_layers.remove(light.data.uv_layers[0])
    light.data.uv_layers.new()
    bpy.ops.object.mode_set(mode='EDIT')
    bpy.ops.mesh.select_all(action='SELECT')
    bpy.ops.uv.smart_project(angle_limit=1.15, island_margin=0.01)
    bpy.ops.object.mode_set(mode='OBJECT')
    bpy.ops.object.shade_smooth()
    return light


MAPS = {'DIFFUSE': ('sRGB', {'pass_filter': {'COLOR'}}), 'NORMAL': ('Non-Color', {'normal_space': 'TANGENT'})}


def bake(scan, light, kinds):
    scene = bpy.context.scene
    scene.render.engine = 'CYCLES'
    scene.cycles.samples = SAMPLES
    scene.cycles.use_denoising = False  # Debian's build has none, and bakes black where it is asked for
    material = bpy.data.materials.new('thumbnail')
    material.use_nodes = True
    light.data.materials.append(material)
    nodes, link = material.node_tree.nodes, material.node_tree.links.new
    surface = nodes['Principled BSDF']
    select(scan, light)
    reach = REACH * max(scan.dimensions)
    for kind in kinds:
        space, how = MAPS[kind]
        node = nodes.new('ShaderNodeTexImage')
        node.image = bpy.data.images.new(kind, TEXELS, TEXELS)
        node.image.colorspace_settings.name = space
        nodes.active = node
        bpy.ops.object.bake(type=kind, use_selected_to_active=True, cage_extrusion=reach, max_ray_distance=2 * reach, margin=8, **how)
        node.image.pack()
        if kind == 'DIFFUSE':
            link(node.outputs['Color'], surface.inputs['Base Color'])
        else:
            tangent = nodes.new('ShaderNodeNormalMap')
            link(node.outputs['Color'], tangent.inputs['Color'])
            link(tangent.outputs['Normal'], surface.inputs['Normal'])


model, out = sys.argv[sys.argv.index('--') + 1:]
scan = read(model)
kinds = ('DIFFUSE', 'NORMAL') if show_colours(scan) else ('NORMAL',)
light = lighten(scan)
bake(scan, light, kinds)
select(light)
turned = not model.endswith(('.ply', '.stl'))  # by its importer
bpy.ops.export_scene.gltf(filepath=out, export_format='GLB', export_image_format='JPEG', export_yup=turned, use_selection=True, export_colors=False)
