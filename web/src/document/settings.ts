// Written by tools/page_settings.py from the tables of the Python package.

/** What can be set: src/shackled/scene/_settings.py. `low` and `high` are null where there is none. */
export type Setting = Readonly<
    Record<"name" | "kind" | "group" | "text" | "unit" | "default", string> &
        Record<"low" | "high", number | null> & { part: string | null; choices: readonly string[] }
>;

/** A look: src/shackled/scene/presets.toml. Lamps are directional; their azimuths are relative to the camera. */
export type Preset = Readonly<
    Record<"name" | "title" | "help" | "ambientLight", string> &
        Record<"wireframe" | "invert", boolean> & {
            material: Readonly<Record<string, number | string>>;
            color: string | null;
            lamps: readonly Readonly<{ azimuth: number; elevation: number; color: string }>[];
            background: Readonly<{ top: string; bottom: string }>;
        }
>;

/** How much gas a request may use, the smallest first: src/shackled/gas/limits.toml, chains.toml. */
export type Limit = Readonly<
    Record<"name" | "place" | "source" | "date" | "remark", string> & { gas: number; kind: "transaction" | "call" }
>;

/** A chain, its currency by symbol; node: one that a wallet can use, or "": src/shackled/gas/chains.toml. */
export type KnownChain = Readonly<Record<"name" | "currency" | "explorer" | "node", string> & { number: number }>;

// prettier-ignore
export const SETTINGS: readonly Setting[] = [
    {"name": "size", "kind": "size", "part": null, "group": "Canvas", "text": "Width and height of the picture.", "unit": "pixels", "choices": [], "default": "the scene's, or 256 for mesh files and pieces of datasets", "low": 1, "high": 2048},
    {"name": "max_triangles", "kind": "count", "part": null, "group": "Canvas", "text": "Number of triangles to which larger meshes are simplified, or all.", "unit": "", "choices": [], "default": "as many as the canvas can show for mesh files, else all", "low": 1, "high": null},
    {"name": "background", "kind": "background", "part": "scene", "group": "Canvas", "text": "Background colour, or the colours of its top and bottom.", "unit": "", "choices": [], "default": "light for mesh files, dark if the surface is very light", "low": null, "high": null},
    {"name": "invert", "kind": "flag", "part": "scene", "group": "Canvas", "text": "Invert all colours, including the background.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "antialias", "kind": "flag", "part": "scene", "group": "Canvas", "text": "Smooth the edges with four samples per pixel.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "rotate", "kind": "rotation", "part": null, "group": "Camera", "text": "Rotate the scene about x, then y, then z, through its middle.", "unit": "degrees", "choices": [], "default": "", "low": null, "high": null},
    {"name": "up_axis", "kind": "choice", "part": null, "group": "Camera", "text": "Up axis of the file, turned upright before `rotate`.", "unit": "", "choices": ["x", "y", "z"], "default": "z for STL files, else y", "low": null, "high": null},
    {"name": "eye", "kind": "vector", "part": "camera", "group": "Camera", "text": "Position of the camera.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "target", "kind": "vector", "part": "camera", "group": "Camera", "text": "Point at which the camera looks.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "up", "kind": "vector", "part": "camera", "group": "Camera", "text": "Direction that points up in the picture.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "azimuth", "kind": "number", "part": "camera", "group": "Camera", "text": "Angle of the camera to the right of the front.", "unit": "degrees", "choices": [], "default": "35 for mesh files", "low": null, "high": null},
    {"name": "elevation", "kind": "number", "part": "camera", "group": "Camera", "text": "Angle of the camera above the horizon.", "unit": "degrees", "choices": [], "default": "20 for mesh files, up to 40 for flat ones", "low": -90, "high": 90},
    {"name": "margin", "kind": "number", "part": "camera", "group": "Camera", "text": "Free border, as a fraction of half the picture.", "unit": "", "choices": [], "default": "0.15 for mesh files", "low": 0, "high": 0.9},
    {"name": "fov", "kind": "number", "part": "camera", "group": "Camera", "text": "Vertical field of view of a perspective camera.", "unit": "degrees", "choices": [], "default": "30 for mesh files, else about 50", "low": 0.2, "high": 179.8},
    {"name": "half_height", "kind": "number", "part": "camera", "group": "Camera", "text": "Half the height of the view, in perspective at distance 1.", "unit": "", "choices": [], "default": "", "low": 0, "high": null},
    {"name": "near", "kind": "number", "part": "camera", "group": "Camera", "text": "Distance of the near plane; nearer geometry is clipped.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "orthographic", "kind": "flag", "part": null, "group": "Camera", "text": "Use an orthographic or a perspective projection.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "preset", "kind": "choice", "part": null, "group": "Light", "text": "Named look: material, colour, lights and background. Other settings modify it.", "unit": "", "choices": ["studio", "clay", "gold", "neon", "noir", "sunset", "facets", "blueprint", "xray", "flat"], "default": "", "low": null, "high": null},
    {"name": "lights", "kind": "lights", "part": "scene", "group": "Light", "text": "Up to four lights, which replace those of the scene.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "ambient_light", "kind": "color", "part": "scene", "group": "Light", "text": "Colour of the ambient light.", "unit": "", "choices": [], "default": "bluish white for mesh files, else white", "low": null, "high": null},
    {"name": "hemisphere", "kind": "hemisphere", "part": "scene", "group": "Light", "text": "Light from the sky above and the ground below, added to the ambient light.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "rim", "kind": "rim", "part": "scene", "group": "Light", "text": "Light along the outlines of objects; its exponent sets its width.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "fog", "kind": "fog", "part": "scene", "group": "Light", "text": "Fog that begins at one distance from the eye and hides everything at another.", "unit": "", "choices": [], "default": "distances of the nearest and the farthest point", "low": null, "high": null},
    {"name": "shadow", "kind": "flag", "part": null, "group": "Light", "text": "Let objects cast shadows from the first light.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "ground", "kind": "ground", "part": "scene", "group": "Light", "text": "Ground under the objects, which receives shadows.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "exposure", "kind": "number", "part": "tone", "group": "Light", "text": "Multiplier of all light.", "unit": "", "choices": [], "default": "1", "low": 0, "high": 64},
    {"name": "filmic", "kind": "flag", "part": "tone", "group": "Light", "text": "Compress bright light as film does, instead of clipping it.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "gamma", "kind": "flag", "part": "tone", "group": "Light", "text": "Add light in linear space instead of as sRGB values.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "shading", "kind": "choice", "part": "material", "group": "Light", "text": "Kind of shading.", "unit": "", "choices": ["unlit", "flat", "smooth"], "default": "depends on `crease` for mesh files", "low": null, "high": null},
    {"name": "crease", "kind": "number", "part": null, "group": "Light", "text": "Compute normals for smooth shading, with hard edges above this angle.", "unit": "degrees", "choices": [], "default": "the normals of the mesh, or an angle that depends on its shape", "low": 0, "high": 180},
    {"name": "smooth", "kind": "flag", "part": null, "group": "Light", "text": "Same as --shading smooth.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "unlit", "kind": "flag", "part": null, "group": "Light", "text": "Same as --shading unlit.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "ambient", "kind": "number", "part": "material", "group": "Light", "text": "Strength of ambient light.", "unit": "", "choices": [], "default": "0.32 for mesh files", "low": 0, "high": 4},
    {"name": "diffuse", "kind": "number", "part": "material", "group": "Light", "text": "Strength of diffuse light.", "unit": "", "choices": [], "default": "0.8 for mesh files", "low": 0, "high": 4},
    {"name": "specular", "kind": "number", "part": "material", "group": "Light", "text": "Strength of highlights.", "unit": "", "choices": [], "default": "0.4 for mesh files", "low": 0, "high": 4},
    {"name": "shininess", "kind": "whole", "part": "material", "group": "Light", "text": "Exponent of highlights; larger values make smaller highlights.", "unit": "", "choices": [], "default": "28 for mesh files", "low": 1, "high": 128},
    {"name": "emission", "kind": "color", "part": "material", "group": "Surface", "text": "Colour of the light that surfaces emit.", "unit": "", "choices": [], "default": "black", "low": null, "high": null},
    {"name": "color", "kind": "color", "part": "object", "group": "Surface", "text": "One colour for all meshes.", "unit": "", "choices": [], "default": "their own", "low": null, "high": null},
    {"name": "cull", "kind": "flag", "part": "object", "group": "Surface", "text": "Cull back faces.", "unit": "", "choices": [], "default": "true for closed parts of mesh files", "low": null, "high": null},
    {"name": "two_sided", "kind": "flag", "part": "object", "group": "Surface", "text": "Light the backs of faces like their fronts.", "unit": "", "choices": [], "default": "true for parts of mesh files that are not culled, up to 16,384 vertices or if the file requests it", "low": null, "high": null},
    {"name": "wireframe", "kind": "flag", "part": "object", "group": "Surface", "text": "Draw edges only.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
    {"name": "opacity", "kind": "number", "part": "object", "group": "Surface", "text": "Opacity of the objects.", "unit": "", "choices": [], "default": "", "low": 0, "high": 1},
    {"name": "animation", "kind": "entry", "part": "file", "group": "glTF files", "text": "Animation that poses the model.", "unit": "", "choices": [], "default": "the first if `time` is given, else the rest pose", "low": null, "high": null},
    {"name": "time", "kind": "number", "part": "file", "group": "glTF files", "text": "Time in the animation.", "unit": "seconds", "choices": [], "default": "0", "low": 0, "high": null},
    {"name": "use_camera", "kind": "entry", "part": "file", "group": "glTF files", "text": "Camera in the file to use, together with the file's lights.", "unit": "", "choices": [], "default": "", "low": null, "high": null},
];

// prettier-ignore
export const PRESETS: readonly Preset[] = [
    {"name": "studio", "title": "Studio", "help": "Its own colours under one soft white light.", "wireframe": false, "invert": false, "material": {"shading": "smooth", "ambient": 0.32, "diffuse": 0.72, "specular": 0.25, "shininess": 24}, "color": null, "lamps": [{"azimuth": -30, "elevation": 42, "color": "#ffffff"}], "background": {"top": "#e9edf2", "bottom": "#9aa5b4"}, "ambientLight": "#ffffff"},
    {"name": "clay", "title": "Clay", "help": "Terracotta on warm paper.", "wireframe": false, "invert": false, "material": {"shading": "smooth", "ambient": 0.3, "diffuse": 0.8, "specular": 0.12, "shininess": 8}, "color": "#c8674a", "lamps": [{"azimuth": -38, "elevation": 50, "color": "#ffffff"}], "background": {"top": "#f6ecdf", "bottom": "#d8c3a9"}, "ambientLight": "#ffeadb"},
    {"name": "gold", "title": "Gold", "help": "Polished metal in the dark.", "wireframe": false, "invert": false, "material": {"shading": "smooth", "ambient": 0.22, "diffuse": 0.62, "specular": 0.95, "shininess": 34}, "color": "#e0a52e", "lamps": [{"azimuth": -35, "elevation": 45, "color": "#fff3d6"}, {"azimuth": 60, "elevation": 10, "color": "#ff9a3c"}], "background": {"top": "#1c130a", "bottom": "#4a3212"}, "ambientLight": "#ffd98a"},
    {"name": "neon", "title": "Neon", "help": "Cyan from the left, magenta from the right.", "wireframe": false, "invert": false, "material": {"shading": "smooth", "ambient": 0.12, "diffuse": 0.85, "specular": 0.8, "shininess": 40}, "color": "#d8dcff", "lamps": [{"azimuth": -70, "elevation": 15, "color": "#00e5ff"}, {"azimuth": 70, "elevation": 10, "color": "#ff2bd6"}], "background": {"top": "#070312", "bottom": "#1d0b3a"}, "ambientLight": "#5a4bff"},
    {"name": "noir", "title": "Noir", "help": "One hard light from the side on black.", "wireframe": false, "invert": false, "material": {"shading": "smooth", "ambient": 0.03, "diffuse": 1.0, "specular": 0.6, "shininess": 30}, "color": "#dddddd", "lamps": [{"azimuth": -75, "elevation": 25, "color": "#ffffff"}], "background": {"top": "#000000", "bottom": "#1b1b1b"}, "ambientLight": "#ffffff"},
    {"name": "sunset", "title": "Sunset", "help": "A low orange sun against a violet sky.", "wireframe": false, "invert": false, "material": {"shading": "flat", "ambient": 0.34, "diffuse": 0.9, "specular": 0.35, "shininess": 16}, "color": null, "lamps": [{"azimuth": -60, "elevation": 12, "color": "#ff9b54"}, {"azimuth": 80, "elevation": 40, "color": "#5a63c8"}], "background": {"top": "#2b1b52", "bottom": "#ff8f5a"}, "ambientLight": "#b9a4ff"},
    {"name": "facets", "title": "Facets", "help": "Every triangle is visible, as in a cut gem.", "wireframe": false, "invert": false, "material": {"shading": "flat", "ambient": 0.2, "diffuse": 0.75, "specular": 0.85, "shininess": 12}, "color": "#5fc7c1", "lamps": [{"azimuth": -40, "elevation": 50, "color": "#ffffff"}, {"azimuth": 65, "elevation": -5, "color": "#7d8cff"}], "background": {"top": "#0f2027", "bottom": "#2c5364"}, "ambientLight": "#ffffff"},
    {"name": "blueprint", "title": "Blueprint", "help": "White lines on blue.", "wireframe": true, "invert": false, "material": {"shading": "unlit", "ambient": 0.3, "diffuse": 0.75, "specular": 0.3, "shininess": 24}, "color": "#e8f1ff", "lamps": [], "background": {"top": "#0b3d91", "bottom": "#072a66"}, "ambientLight": "#ffffff"},
    {"name": "xray", "title": "X-ray", "help": "Light and dark are swapped.", "wireframe": false, "invert": true, "material": {"shading": "smooth", "ambient": 0.1, "diffuse": 0.9, "specular": 0.2, "shininess": 10}, "color": "#f2e6dc", "lamps": [{"azimuth": 0, "elevation": 0, "color": "#ffffff"}], "background": {"top": "#f4f1ea", "bottom": "#ffffff"}, "ambientLight": "#ffffff"},
    {"name": "flat", "title": "Unlit", "help": "Unlit colours; lowest gas.", "wireframe": false, "invert": false, "material": {"shading": "unlit", "ambient": 0.3, "diffuse": 0.75, "specular": 0.3, "shininess": 24}, "color": null, "lamps": [], "background": {"top": "#f4f1ea", "bottom": "#f4f1ea"}, "ambientLight": "#ffffff"},
];

// prettier-ignore
export const LIMITS: readonly Limit[] = [
    {"name": "one transaction on Ethereum", "gas": 16777216, "kind": "transaction", "place": "Ethereum", "source": "https://eips.ethereum.org/EIPS/eip-7825", "date": "2025-12-03", "remark": ""},
    {"name": "one transaction on Base", "gas": 16777216, "kind": "transaction", "place": "Base", "source": "https://docs.base.org/base-chain/network-information/throughput-and-limits", "date": "2026-11-29", "remark": ""},
    {"name": "one transaction on OP Mainnet", "gas": 16777216, "kind": "transaction", "place": "OP Mainnet", "source": "https://github.com/ethereum-optimism/optimism/pull/20070", "date": "2026-04-14", "remark": ""},
    {"name": "one transaction on Monad", "gas": 30000000, "kind": "transaction", "place": "Monad", "source": "https://docs.monad.xyz/developer-essentials/gas-pricing", "date": "2026-11-29", "remark": ""},
    {"name": "one transaction on Arbitrum One", "gas": 32000000, "kind": "transaction", "place": "Arbitrum One", "source": "https://eips.ethereum.org/EIPS/eip-8123", "date": "2026-01-11", "remark": ""},
    {"name": "one transaction on Polygon", "gas": 32000000, "kind": "transaction", "place": "Polygon", "source": "https://eips.ethereum.org/EIPS/eip-8123", "date": "2026-01-11", "remark": ""},
    {"name": "eth_call, geth: default of --rpc.gascap", "gas": 50000000, "kind": "call", "place": "geth", "source": "https://geth.ethereum.org/docs/fundamentals/command-line-options", "date": "2025-01-27", "remark": "as github.com/besu-eth/besu/issues/8175 found it there on this date"},
    {"name": "eth_call, reth: default of --rpc.gascap", "gas": 50000000, "kind": "call", "place": "reth", "source": "https://github.com/paradigmxyz/reth/pull/3812", "date": "2023-07-17", "remark": ""},
    {"name": "eth_call, Erigon: default of --rpc.gascap", "gas": 50000000, "kind": "call", "place": "Erigon", "source": "https://github.com/besu-eth/besu/issues/8175", "date": "2025-01-27", "remark": "as another client's developers compare it"},
    {"name": "eth_call, Nethermind since April 2026: default of JsonRpc.GasCap", "gas": 100000000, "kind": "call", "place": "Nethermind", "source": "https://github.com/NethermindEth/nethermind/pull/11282", "date": "2026-04-21", "remark": "earlier versions stop at the gas limit of a block, whatever is configured"},
    {"name": "eth_call, Besu: default of --rpc-gas-cap", "gas": 100000000, "kind": "call", "place": "Besu", "source": "https://github.com/besu-eth/besu/pull/8738", "date": "2025-06-04", "remark": "50 million before, and no limit until 2025-02"},
    {"name": "eth_call, Alchemy", "gas": 550000000, "kind": "call", "place": "Alchemy", "source": "https://www.alchemy.com/docs/reference/gas-limits-for-eth_call-and-eth_estimategas", "date": "2026-11-21", "remark": "the page bears no date: the day on which a copy of it was read"},
];

// prettier-ignore
export const CHAINS: readonly KnownChain[] = [
    {"number": 1, "name": "Ethereum", "currency": "ETH", "explorer": "https://etherscan.io", "node": ""},
    {"number": 8453, "name": "Base", "currency": "ETH", "explorer": "https://basescan.org", "node": ""},
    {"number": 10, "name": "OP Mainnet", "currency": "ETH", "explorer": "https://optimistic.etherscan.io", "node": ""},
    {"number": 143, "name": "Monad", "currency": "MON", "explorer": "https://monadscan.com", "node": ""},
    {"number": 42161, "name": "Arbitrum One", "currency": "ETH", "explorer": "https://arbiscan.io", "node": ""},
    {"number": 137, "name": "Polygon", "currency": "POL", "explorer": "https://polygonscan.com", "node": ""},
    {"number": 11155111, "name": "Sepolia", "currency": "ETH", "explorer": "https://sepolia.etherscan.io", "node": "https://11155111.rpc.thirdweb.com"},
    {"number": 560048, "name": "Hoodi", "currency": "ETH", "explorer": "https://hoodi.etherscan.io", "node": "https://rpc.hoodi.ethpandaops.io"},
    {"number": 31337, "name": "a development chain", "currency": "ETH", "explorer": "", "node": "http://127.0.0.1:8545"},
];

/** The bounds of quotes, in wei per gas, and the margin of gas limits, as a fraction: src/shackled/deploy/_quote.py. */
export const BOUNDS = { tip: 1000000000n, mostTip: 3000000000n, mostTimes: 10n, margin: [21n, 20n] } as const;

/** Gas: of minting a token, besides that of its data; of a transaction that reveals, and of each round in it. */
export const USUAL_GAS = { mint: 65000, reveal: 45000, round: 50000 } as const;
