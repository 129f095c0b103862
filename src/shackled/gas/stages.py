"""The stages of a picture, and which sources belong to them."""

from __future__ import annotations

from .source_map import SourceMap

SETUP, ROWS = "triangle set-up", "rows of plain triangles"
SHADING, LIGHTING = "shading set-up", "lighting set-up"
REST = "calls, bands, memory"

#: In the order in which a picture is made.
STAGES = (
    "checks",
    "vertex shader",
    "primitive assembly",
    LIGHTING,
    SHADING,
    SETUP,
    ROWS,
    "fragment shader",
    "compositor",
    "encoding",
    REST,
)

#: The stage of each source; of the two that belong to two stages, that of most functions. Others serve all stages.
_SOURCES = {
    "scene/Checks.sol": "checks",
    "pipeline/View.sol": "vertex shader",
    "pipeline/VertexShader.sol": "vertex shader",
    "pipeline/PrimitiveAssembly.sol": "primitive assembly",
    "pipeline/Clipper.sol": "primitive assembly",
    "pipeline/Shading.sol": SHADING,
    "pipeline/Lighting.sol": LIGHTING,
    "pipeline/Rasterizer.sol": SETUP,
    "pipeline/Wireframe.sol": ROWS,
    "pipeline/FragmentShader.sol": "fragment shader",
    "pipeline/Compositor.sol": "compositor",
    "encode/Bmp.sol": "encoding",
    "encode/Base64.sol": "encoding",
    "encode/Svg.sol": "encoding",
    "encode/Text.sol": "encoding",
    "pipeline/Pipeline.sol": REST,
    "Engine.sol": REST,
    "Renderer.sol": REST,
}
_FUNCTIONS = {
    "Rasterizer.rows": ROWS,
    "Lighting.setFace": SHADING,
    "Lighting.setFaceNormal": SHADING,
    "Lighting.facePointLight": SHADING,
}


def stages_of(source_map: SourceMap) -> dict[int, str]:
    """The stage of each instruction, by its position; none for what serves all stages and for the compiler's own."""
    stages = {}
    for at, place in source_map.places.items():
        if place.function is not None:
            stage = _FUNCTIONS.get(place.function) or _SOURCES.get(place.file)
            if stage is not None:
                stages[at] = stage
    return stages
