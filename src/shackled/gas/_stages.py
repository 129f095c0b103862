"""The stages of a picture, and the source files of each."""

from __future__ import annotations

from ._source_map import SourceMap

SETUP, ROWS = "triangle set-up", "rows of plain triangles"
UNIFORMS, SHADING, FRAGMENTS = "uniforms", "shading set-up", "fragment shader"
REST = "calls, bands, memory"

#: In the order in which a picture is made.
STAGES = (
    "checks",
    UNIFORMS,
    "vertex shader",
    "primitive assembly",
    SHADING,
    SETUP,
    ROWS,
    FRAGMENTS,
    "compositor",
    "encoding",
    REST,
)

#: The stage of a folder of sources, and of files in it with another one, or with none: these serve the stages that call
#: them, as do sources that are not listed. Of a file that belongs to two stages, that of most functions.
_SOURCES = {
    "scene/Checks.sol": "checks",
    "scene/Extensions.sol": "checks",
    "uniforms": UNIFORMS,
    "uniforms/Runs.sol": REST,
    "uniforms/TileCulling.sol": "primitive assembly",
    "shadows": UNIFORMS,
    "shadows/ShadowRows.sol": FRAGMENTS,
    "effects": FRAGMENTS,
    "effects/EffectRecords.sol": UNIFORMS,
    "effects/EffectUniforms.sol": UNIFORMS,
    "effects/Effects.sol": UNIFORMS,
    "pipeline": REST,
    "pipeline/Compositor.sol": "compositor",
    "pipeline/geometry": "primitive assembly",
    "pipeline/geometry/VertexShader.sol": "vertex shader",
    "pipeline/geometry/Rasterizer.sol": SETUP,
    "pipeline/geometry/Triangles.sol": SETUP,
    "pipeline/geometry/Screen.sol": None,
    "pipeline/shading": SHADING,
    "pipeline/shading/FragmentLight.sol": FRAGMENTS,
    "pipeline/shading/Wires.sol": ROWS,
    "pipeline/pixels": FRAGMENTS,
    "pipeline/pixels/DepthBuffer.sol": REST,
    "pipeline/pixels/PixelRasterizer.sol": SETUP,
    "pipeline/pixels/LinearSpans.sol": ROWS,
    "pipeline/pixels/Wireframe.sol": ROWS,
    "pipeline/samples": FRAGMENTS,
    "pipeline/samples/SampleBuffer.sol": "compositor",
    "pipeline/samples/SampleRasterizer.sol": SETUP,
    "pipeline/samples/LinearSamples.sol": ROWS,
    "pipeline/samples/SampleWires.sol": ROWS,
    "engines": REST,
    "encode": "encoding",
    "Renderer.sol": REST,
}


def stages_of(source_map: SourceMap) -> dict[int, str]:
    """Return the stage of each instruction by its position; code that serves several stages has none."""
    found = {
        at: _SOURCES.get(place.file, _SOURCES.get(place.file.rpartition("/")[0]))
        for at, place in source_map.places.items()
        if place.function is not None
    }
    return {at: stage for at, stage in found.items() if stage is not None}
