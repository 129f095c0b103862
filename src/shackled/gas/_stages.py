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

#: The stage of each source; of one that belongs to two stages, that of most functions. Others serve all stages.
_SOURCES = {
    "scene/Checks.sol": "checks",
    "scene/Extensions.sol": "checks",
    "uniforms/Uniforms.sol": UNIFORMS,
    "uniforms/Runs.sol": REST,
    "uniforms/View.sol": UNIFORMS,
    "uniforms/Transform.sol": UNIFORMS,
    "uniforms/Lights.sol": UNIFORMS,
    "uniforms/MeshSpace.sol": UNIFORMS,
    "uniforms/Materials.sol": UNIFORMS,
    "uniforms/Specular.sol": UNIFORMS,
    "pipeline/geometry/VertexShader.sol": "vertex shader",
    "uniforms/TileCulling.sol": "primitive assembly",
    "pipeline/geometry/Indices.sol": "primitive assembly",
    "pipeline/geometry/PrimitiveAssembly.sol": "primitive assembly",
    "pipeline/geometry/Clipper.sol": "primitive assembly",
    "pipeline/shading/Shading.sol": SHADING,
    "pipeline/shading/FlatShading.sol": SHADING,
    "pipeline/shading/SmoothShading.sol": SHADING,
    "pipeline/shading/VertexHighlights.sol": SHADING,
    "pipeline/shading/Quadratic.sol": SHADING,
    "pipeline/shading/Lighting.sol": SHADING,
    "pipeline/geometry/Rasterizer.sol": SETUP,
    "pipeline/pixels/PixelRasterizer.sol": SETUP,
    "pipeline/samples/SampleRasterizer.sol": SETUP,
    "pipeline/geometry/Triangles.sol": SETUP,
    "pipeline/pixels/LinearSpans.sol": ROWS,
    "pipeline/samples/LinearSamples.sol": ROWS,
    "pipeline/pixels/Wireframe.sol": ROWS,
    "pipeline/samples/SampleWires.sol": ROWS,
    "pipeline/shading/Wires.sol": ROWS,
    "pipeline/shading/Patches.sol": FRAGMENTS,
    "pipeline/pixels/PatchSpans.sol": FRAGMENTS,
    "pipeline/pixels/Spans.sol": FRAGMENTS,
    "pipeline/shading/SmoothVertex.sol": FRAGMENTS,
    "pipeline/shading/SmoothTriangle.sol": FRAGMENTS,
    "pipeline/pixels/SmoothSpans.sol": FRAGMENTS,
    "pipeline/shading/FragmentLight.sol": FRAGMENTS,
    "pipeline/samples/Samples.sol": FRAGMENTS,
    "pipeline/samples/PatchSamples.sol": FRAGMENTS,
    "pipeline/samples/ExactSamples.sol": FRAGMENTS,
    "pipeline/samples/BlendedSamples.sol": FRAGMENTS,
    "pipeline/samples/SmoothSamples.sol": FRAGMENTS,
    "effects/EffectSamples.sol": FRAGMENTS,
    "effects/SurfaceLight.sol": FRAGMENTS,
    "shadows/ShadowRows.sol": FRAGMENTS,
    "effects/Ground.sol": FRAGMENTS,
    "effects/Gamma.sol": FRAGMENTS,
    "pipeline/Compositor.sol": "compositor",
    "pipeline/samples/SampleBuffer.sol": "compositor",
    "encode/Bmp.sol": "encoding",
    "encode/Base64.sol": "encoding",
    "encode/Svg.sol": "encoding",
    "encode/Text.sol": "encoding",
    "pipeline/Pipeline.sol": REST,
    "pipeline/pixels/DepthBuffer.sol": REST,
    "engines/Engine.sol": REST,
    "engines/FragmentEngine.sol": REST,
    "engines/AntialiasedEngine.sol": REST,
    "engines/AntialiasedFragmentEngine.sol": REST,
    "engines/EffectsEngine.sol": REST,
    "effects/Effects.sol": UNIFORMS,
    "shadows/Shadows.sol": UNIFORMS,
    "shadows/LightSpace.sol": UNIFORMS,
    "shadows/Faces.sol": UNIFORMS,
    "shadows/Casters.sol": UNIFORMS,
    "shadows/Receivers.sol": UNIFORMS,
    "shadows/Clipping.sol": UNIFORMS,
    "shadows/Outlines.sol": UNIFORMS,
    "Renderer.sol": REST,
}


def stages_of(source_map: SourceMap) -> dict[int, str]:
    """Return the stage of each instruction by its position; code that serves several stages has none."""
    stages = {}
    for at, place in source_map.places.items():
        if place.function is not None:
            stage = _SOURCES.get(place.file)
            if stage is not None:
                stages[at] = stage
    return stages
