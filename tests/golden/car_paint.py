# Makes a material of Blender's Principled BSDF (4.0 or newer): run it in the text editor.
# A fit: log_error 0.0123, studio PSNR 31.2 dB, mean ΔE_ITP 4.5
import bpy

NAME = "car paint & co"
INPUTS = {
    "Base Color": [0.25,0.125,0.0,1.0],
    "Coat IOR": 1.5,
    "Coat Roughness": 0.1,
    "Coat Weight": 0.75,
    "IOR": 1.6,
    "Metallic": 0.5,
    "Roughness": 0.3,
    "Specular IOR Level": 0.5,
    "Specular Tint": [1.0,1.0,1.0,1.0],
}


def make(name=NAME, inputs=INPUTS):
    """A new material whose surface is one Principled BSDF with these inputs."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    node = nodes.new("ShaderNodeBsdfPrincipled")
    node.distribution = "MULTI_GGX"
    for socket, value in inputs.items():
        node.inputs[socket].default_value = value
    output = nodes.new("ShaderNodeOutputMaterial")
    output.location = (300, 0)
    links.new(node.outputs["BSDF"], output.inputs["Surface"])
    return material


if __name__ == "__main__":
    make()
