// Written by tools/page_settings.py from src/shackled/scene/_files/signatures.toml.

/** How a file begins, and what it is: the table explains the keys. */
export interface Signature {
    name: string;
    begins: string;
    case?: boolean;
    text?: boolean;
    format?: string;
    do?: string;
}

// prettier-ignore
export const SIGNATURES: readonly Signature[] = [
    {"name": "a Git LFS pointer, not the file itself", "begins": "version https?://(?:git-lfs|git-media|hawser)\\b", "do": "run `git lfs pull` in its repository, or download the file itself"},
    {"name": "a GLB file", "begins": "glTF", "format": ".glb"},
    {"name": "a PNG picture", "begins": "\\x89PNG\\r\\n\\x1a\\n", "format": ".png"},
    {"name": "a PLY file", "begins": "ply[ \\t\\r\\n]", "case": false, "format": ".ply"},
    {"name": "a 3MF file", "begins": "PK\\x03\\x04[\\s\\S]*3D/[^\\0/]*\\.model", "case": false, "do": "save it as STL, OBJ or GLB in the program that made it"},
    {"name": "a USDZ file", "begins": "PK\\x03\\x04[\\s\\S]{26}[^\\0]{1,200}\\.usd[acz]?", "case": false, "do": "convert it to GLB"},
    {"name": "a zip archive", "begins": "PK(?:\\x03\\x04|\\x05\\x06|\\x07\\x08)", "do": "unpack it, and give a file that is in it"},
    {"name": "a 7z, RAR, xz, bzip2 or zstd file", "begins": "7z\\xbc\\xaf\\x27\\x1c|Rar!\\x1a\\x07|\\xfd7zXZ\\x00|BZh[1-9]1AY&SY|\\x28\\xb5\\x2f\\xfd", "do": "unpack it, and give a file that is in it"},
    {"name": "a gzip file", "begins": "\\x1f\\x8b\\x08", "do": "unpack it, and give the file that is in it"},
    {"name": "a tar archive", "begins": "[^\\0][\\s\\S]{256}ustar[\\0 ]", "do": "unpack it, and give a file that is in it"},
    {"name": "an FBX file", "begins": "Kaydara FBX Binary|; FBX \\d", "do": "export it as GLB, for instance with Blender"},
    {"name": "a STEP file of CAD", "begins": "[ \\t\\r\\n]*ISO-10303-21", "do": "export it as STL in a CAD program, for instance FreeCAD"},
    {"name": "an IGES file of CAD", "begins": "[^\\0\\r\\n]{72}S[ 0]{6}1[ \\t]*[\\r\\n]", "text": true, "do": "export it as STL in a CAD program, for instance FreeCAD"},
    {"name": "a DXF drawing", "begins": "(?:[ \\t]*999\\r?\\n[^\\n]*\\n)*[ \\t]*0\\r?\\nSECTION\\r?\\n", "text": true, "do": "export it as STL or OBJ in a CAD program"},
    {"name": "a DWG drawing", "begins": "AC10[0-9]{2}\\x00", "do": "export it as STL or OBJ in a CAD program"},
    {"name": "a Rhino file", "begins": "3D Geometry File Format", "do": "export it as STL, OBJ or GLB with Rhino"},
    {"name": "a Blender file", "begins": "BLENDER[-_0-9]", "do": "export it as GLB with Blender"},
    {"name": "a 3DS file", "begins": "MM[\\s\\S]{4}(?:\\x02\\x00\\x0a\\x00|==)", "do": "export it as GLB, for instance with Blender"},
    {"name": "a USD file", "begins": "PXR-USDC|#usda ", "do": "convert it to GLB, for instance with Blender"},
    {"name": "a VTK file", "begins": "# vtk DataFile|(?:<\\?xml[^>]*>[ \\t\\r\\n]*)?<VTKFile", "do": "save its surface as PLY or STL, for instance with ParaView"},
    {"name": "a VRML file", "begins": "#VRML V", "do": "export it as GLB, for instance with Blender"},
    {"name": "a MagicaVoxel file", "begins": "VOX [\\s\\S]\\0\\0\\0", "do": "export it as OBJ or PLY with MagicaVoxel"},
    {"name": "a Draco file without a glTF file around it", "begins": "DRACO[\\x01\\x02]", "do": "convert it to GLB, or PLY"},
    {"name": "a file of materials", "begins": "(?:#[^\\n]*\\n|[ \\t\\r\\n])*newmtl[ \\t]", "text": true, "format": ".mtl", "do": "give the OBJ file that it belongs to"},
    {"name": "a COLLADA file", "begins": "[ \\t\\r\\n]*<\\?xml[\\s\\S]{0,2000}<COLLADA\\b", "do": "export it as GLB, for instance with Blender"},
    {"name": "an SVG picture", "begins": "[ \\t\\r\\n]*(?:<\\?xml[\\s\\S]{0,2000})?<svg\\b", "do": "give a mesh or scene file"},
    {"name": "a web page, not the file that was to be downloaded", "begins": "[ \\t\\r\\n]*(?:<\\?xml[^>]*>|<[!]--[\\s\\S]{0,2000}?-->|[ \\t\\r\\n])*<(?:!doctype[ \\t]+html|html|head|body)\\b", "case": false, "do": "download the file itself, for instance by the link Raw or Download of the page"},
    {"name": "an XML document", "begins": "[ \\t\\r\\n]*<\\?xml\\b", "do": "export the model as GLB, OBJ or STL"},
    {"name": "a PDF document", "begins": "%PDF-", "do": "give a mesh or scene file"},
    {"name": "a picture", "begins": "\\xff\\xd8\\xff|GIF8[79]a[\\s\\S]|RIFF[\\s\\S]{4}WEBP|II\\*\\0|MM\\0\\*|BM[\\s\\S]{4}\\0{4}[\\s\\S]{3}\\0[\\x0c\\x28\\x38\\x40\\x6c\\x7c]\\0\\0\\0|DDS \\x7c\\0\\0\\0|v/1\\x01|\\0\\0\\0[\\s\\S]ftyp(?:avif|heic)", "do": "give a mesh or scene file; a texture is read with the mesh file that names it"},
    {"name": "a side file of macOS, not the file itself", "begins": "\\0\\x05\\x16\\x07", "do": "give the file of the same name without ._ before it"},
    {"name": "a text STL file", "begins": "[ \\t\\r\\n]*solid\\b[^\\0]*?\\bfacet\\b", "case": false, "text": true, "format": ".stl"},
    {"name": "an OFF file", "begins": "(?:#[^\\n]*\\n|[ \\t\\r\\n])*(?:ST|C|N)*(?:4?n)?OFF(?:\\b|\\d)", "format": ".off"},
    {"name": "an OBJ file", "begins": "(?:#[^\\n]*\\n|[ \\t\\r\\n])*(?:(?:v|vn|vt)[ \\t]+[-+.]?\\d|(?:o|g|s|mtllib|usemtl)[ \\t]+[^= \\t\\r\\n])", "text": true, "format": ".obj"},
    {"name": "a glTF file", "begins": "[ \\t\\r\\n]*\\{[\\s\\S]*\"(?:asset|accessors|bufferViews)\"[ \\t\\r\\n]*:", "text": true, "format": ".gltf"},
    {"name": "a scene file in JSON", "begins": "[ \\t\\r\\n]*\\{", "text": true, "format": ".json"},
    {"name": "a scene file in TOML", "begins": "(?:[^\\n]*\\n)*[ \\t]*\\[\\[[ \\t]*objects[ \\t]*\\]\\]", "text": true, "format": ".toml"},
];

// prettier-ignore
export const DAMAGED = {"least": 8, "name": "binary data that was damaged when it was copied as text", "do": "download or copy it again, as a binary file"};
