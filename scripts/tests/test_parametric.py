"""Files of parametric fits, as the programs that they are for read them. What is in them is tested in Rust."""

import sys
from pathlib import Path
from types import ModuleType
from unittest.mock import MagicMock

import MaterialX as mx
import pytest

GOLDEN = Path(__file__).resolve().parents[2] / "tests" / "golden"


@pytest.fixture
def document() -> mx.Document:
    document = mx.createDocument()
    mx.readFromXmlFile(document, str(GOLDEN / "car_paint.mtlx"))
    libraries = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), libraries)
    document.setDataLibrary(libraries)
    return document


def test_materialx_validates_the_file(document: mx.Document) -> None:
    valid, message = document.validate()
    assert valid, message


def test_every_input_is_one_of_open_pbr_and_of_its_type(document: mx.Document) -> None:
    surface = document.getNode("car_paint___co_surface")
    definition = surface.getNodeDef()
    assert definition is not None and surface.getCategory() == "open_pbr_surface"
    for given in surface.getInputs():
        known = definition.getActiveInput(given.getName())
        assert known is not None and known.getType() == given.getType(), given.getName()
    assert surface.getInputValue("specular_ior") == pytest.approx(1.6)


def test_the_surface_is_that_of_the_material(document: mx.Document) -> None:
    (material,) = document.getMaterialNodes()
    (shader,) = mx.getShaderNodes(material)
    assert shader.getName() == "car_paint___co_surface"


def test_the_program_for_blender_sets_every_input_of_one_node(monkeypatch: pytest.MonkeyPatch) -> None:
    bpy = MagicMock()
    monkeypatch.setitem(sys.modules, "bpy", bpy)
    program = ModuleType("program")
    exec(compile((GOLDEN / "car_paint.py").read_text(), "car_paint.py", "exec"), program.__dict__)
    material = program.make()
    bpy.data.materials.new.assert_called_once_with("car paint & co")
    made = [call.args[0] for call in material.node_tree.nodes.new.call_args_list]
    assert made == ["ShaderNodeBsdfPrincipled", "ShaderNodeOutputMaterial"]
    sockets = [call.args[0] for call in material.node_tree.nodes.new.return_value.inputs.__getitem__.call_args_list]
    assert sockets == [*program.INPUTS, "Surface"]
    assert len(program.INPUTS["Base Color"]) == 4
