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
    "pipeline/VertexShader.sol": "vertex shader",
    "uniforms/TileCulling.sol": "primitive assembly",
    "pipeline/Indices.sol": "primitive assembly",
    "pipeline/PrimitiveAssembly.sol": "primitive assembly",
    "pipeline/Clipper.sol": "primitive assembly",
    "pipeline/Shading.sol": SHADING,
    "pipeline/FlatShading.sol": SHADING,
    "pipeline/SmoothShading.sol": SHADING,
    "pipeline/VertexHighlights.sol": SHADING,
    "pipeline/Quadratic.sol": SHADING,
    "pipeline/Lighting.sol": SHADING,
    "pipeline/Rasterizer.sol": SETUP,
    "pipeline/PixelRasterizer.sol": SETUP,
    "pipeline/SampleRasterizer.sol": SETUP,
    "pipeline/Triangles.sol": SETUP,
    "pipeline/LinearSpans.sol": ROWS,
    "pipeline/LinearSamples.sol": ROWS,
    "pipeline/Wireframe.sol": ROWS,
    "pipeline/SampleWires.sol": ROWS,
    "pipeline/Patches.sol": FRAGMENTS,
    "pipeline/ExactSpans.sol": FRAGMENTS,
    "pipeline/BlendedSpans.sol": FRAGMENTS,
    "pipeline/SmoothLight.sol": FRAGMENTS,
    "pipeline/FragmentLight.sol": FRAGMENTS,
    "pipeline/Samples.sol": FRAGMENTS,
    "pipeline/PatchSamples.sol": FRAGMENTS,
    "pipeline/ExactSamples.sol": FRAGMENTS,
    "pipeline/BlendedSamples.sol": FRAGMENTS,
    "pipeline/SmoothSamples.sol": FRAGMENTS,
    "pipeline/EffectSamples.sol": FRAGMENTS,
    "pipeline/SurfaceLight.sol": FRAGMENTS,
    "pipeline/ShadowRows.sol": FRAGMENTS,
    "pipeline/Ground.sol": FRAGMENTS,
    "math/Gamma.sol": FRAGMENTS,
    "pipeline/Compositor.sol": "compositor",
    "pipeline/SampleBuffer.sol": "compositor",
    "encode/Bmp.sol": "encoding",
    "encode/Base64.sol": "encoding",
    "encode/Svg.sol": "encoding",
    "encode/Text.sol": "encoding",
    "pipeline/Pipeline.sol": REST,
    "pipeline/DepthBuffer.sol": REST,
    "Engine.sol": REST,
    "FragmentEngine.sol": REST,
    "AntialiasedEngine.sol": REST,
    "AntialiasedFragmentEngine.sol": REST,
    "EffectsEngine.sol": REST,
    "Effects.sol": UNIFORMS,
    "shadows/Shadows.sol": UNIFORMS,
    "shadows/LightSpace.sol": UNIFORMS,
    "shadows/Faces.sol": UNIFORMS,
    "shadows/Receivers.sol": UNIFORMS,
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
