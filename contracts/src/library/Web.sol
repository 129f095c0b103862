// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

import {Bytes} from "@openzeppelin/contracts/utils/Bytes.sol";
import {Strings} from "@openzeppelin/contracts/utils/Strings.sol";
import {IGenesis} from "../interfaces/IGenesis.sol";
import {ILibrary} from "../interfaces/ILibrary.sol";
import {IStudio} from "../interfaces/IStudio.sol";
import {Item} from "../interfaces/Item.sol";

/// @notice A parameter of a request, or a header of a response (ERC-5219).
struct KeyValue {
    string key;
    string value;
}

/// @title Web: pictures at readable web3:// URLs, such as web3://ADDRESS/icons/crown.png.
/// @notice Sources: ERC-4804 and ERC-6860 (web3:// URLs), ERC-5219 (requests).
///
/// /                       a page with links to all pictures
/// /icons/crown.png        an icon; /icons/crown.glb is its 3D model
/// /objects/teapot.png     a common object; /objects/teapot.glb is its 3D model
/// /genesis/12.png         the piece of the seed keccak256("shackled-12"); or of a seed given as 0x and 64 hexadecimal digits
///
/// Pictures have 512 x 512 pixels. ?scale=1 to 8 enlarges each pixel of the 128 x 128 drawing to a square of scale x scale pixels.
contract Web {
    using Bytes for bytes;
    using Strings for string;
    using Strings for uint256;

    uint256 private constant DEFAULT_SCALE = 4;
    /// @dev The number of pieces on the page.
    uint256 private constant PIECES = 12;
    /// @dev The beginning of the page.
    string private constant HEAD =
        '<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
        "<title>Shackled</title><style>body{font:15px system-ui;margin:2rem auto;max-width:70rem;padding:0 1rem;"
        "color:#16181d;background:#f4f3ef}a{display:inline-block;width:128px;margin:0 12px 12px 0;color:inherit;text-decoration:none}"
        "img{display:block;width:128px;height:128px;border-radius:8px;image-rendering:pixelated}p{color:#5d616a}</style>"
        "<h1>Shackled</h1><p>Pictures of 3D scenes, drawn by contracts. Add ?scale=1 to 8, or use .glb instead of .png for a 3D model.</p>";
    /// @dev Successful responses never change; error responses can, since items can still be stored.
    string private constant CACHE = "public, max-age=31536000, immutable";

    /// @notice The library of items.
    ILibrary public immutable items;
    /// @notice The Studio that draws the items.
    IStudio public immutable studio;
    /// @notice The contract that generates and draws pieces.
    IGenesis public immutable genesis;

    /// @notice The address has no code.
    error NoContract(address contract_);

    constructor(ILibrary items_, IStudio studio_, IGenesis genesis_) {
        check(address(items_));
        check(address(studio_));
        check(address(genesis_));
        (items, studio, genesis) = (items_, studio_, genesis_);
    }

    /// @notice Selects ERC-5219 mode (ERC-4804).
    function resolveMode() external pure returns (bytes32) {
        return "5219";
    }

    /// @notice Responds to an HTTP request.
    /// @param resource The segments of the path.
    /// @param params The query parameters.
    /// @return statusCode 200; 400 for an invalid parameter; 404 for an unknown path.
    /// @return body The file, or an error message as text.
    /// @return headers The media type, and the caching policy.
    function request(string[] calldata resource, KeyValue[] calldata params)
        external view returns (uint16 statusCode, string memory body, KeyValue[] memory headers)
    {
        if (resource.length == 0 || (resource.length == 1 && bytes(resource[0]).length == 0)) {
            return answer("text/html", page(), "no-cache");
        }
        if (resource.length != 2) return refused(404, "Unknown path. The page / lists all pictures.");
        uint256 scale = DEFAULT_SCALE;
        for (uint256 k; k != params.length; ++k) {
            bytes memory value = bytes(params[k].value);
            if (!params[k].key.equal("scale")) continue;
            if (value.length != 1 || value[0] < "1" || value[0] > "8") return refused(400, "scale must be a number from 1 to 8.");
            scale = uint8(value[0]) - 48;
        }
        (string memory name, string memory kind) = split(resource[1]);
        bool isPng = kind.equal("png");
        if (resource[0].equal("genesis") && isPng) return ofGenesis(name, scale);
        bool isIcon = resource[0].equal("icons");
        if ((isIcon || resource[0].equal("objects")) && (isPng || kind.equal("glb"))) return ofItem(name, isIcon, isPng, scale);
        return refused(404, "Unknown path. Use /icons/NAME.png, /objects/NAME.png, the same with .glb, or /genesis/SEED.png.");
    }

    function ofItem(string memory name, bool isIcon, bool isPng, uint256 scale)
        private view returns (uint16, string memory, KeyValue[] memory)
    {
        try items.find(name) returns (Item memory item) {
            if (item.isIcon != isIcon) return refused(404, isIcon ? "Not an icon: see /objects/." : "Not an object: see /icons/.");
            if (!items.isStored(name)) {
                string memory command = string.concat("shackled library store ", name);
                return refused(404, string.concat("Not stored on this chain yet. Anyone can store it: ", command, "."));
            }
            if (isPng) return answer("image/png", string(studio.renderPNG(item.scene, scale)), CACHE);
            return answer("model/gltf-binary", string(studio.glb(item.scene)), CACHE);
        } catch {
            return refused(404, "No item has this name. The page / lists all names.");
        }
    }

    function ofGenesis(string memory name, uint256 scale) private view returns (uint16, string memory, KeyValue[] memory) {
        bytes memory text = bytes(name);
        (bool isSeed, uint256 seed) = (false, 0);
        // the parsers revert for numbers of more than 256 bits
        if (text.length == 66 && text[1] == "x") (isSeed, seed) = name.tryParseHexUint();
        else if (text.length != 0 && text.length < 78) {
            (isSeed, seed) = name.tryParseUint();
            seed = uint256(keccak256(bytes(string.concat("shackled-", seed.toString()))));
        }
        if (!isSeed) return refused(404, "Give a number, or a seed as 0x and 64 hexadecimal digits.");
        try genesis.render(bytes32(seed)) returns (bytes memory bitmap) {
            return answer("image/png", string(studio.encoder().encode(bitmap, scale)), CACHE);
        } catch (bytes memory reason) {
            bytes4 code = bytes4(reason);
            if (code == IGenesis.NoTriangle.selector || code == IGenesis.NoPrismToChoose.selector) {
                return refused(404, "This seed yields no piece.");
            }
            // the call had too little gas
            assembly ("memory-safe") {
                revert(add(reason, 0x20), mload(reason))
            }
        }
    }

    /// @dev Returns the page with links to all pictures.
    function page() private view returns (string memory html) {
        html = HEAD;
        string[] memory names = items.names();
        bool isIcon;
        for (uint256 k; k != names.length; ++k) {
            bool wasIcon = isIcon;
            isIcon = items.find(names[k]).isIcon;
            if (k == 0 || isIcon != wasIcon) html = string.concat(html, isIcon ? "<h2>Icons</h2>" : "<h2>Objects</h2>");
            string memory path = string.concat(isIcon ? "/icons/" : "/objects/", names[k]);
            string memory absent = string.concat("<p>", names[k], ": not stored on this chain yet</p>");
            html = string.concat(html, items.isStored(names[k]) ? tile(path, names[k]) : absent);
        }
        html = string.concat(html, "<h2>Genesis</h2>");
        for (uint256 k; k != PIECES; ++k) html = string.concat(html, tile(string.concat("/genesis/", k.toString()), k.toString()));
    }

    function tile(string memory path, string memory name) private pure returns (string memory) {
        return string.concat('<a href="', path, '.png"><img src="', path, '.png?scale=1" alt="" loading="lazy">', name, "</a>");
    }

    /// @dev Splits a file name at its last dot.
    function split(string memory text) private pure returns (string memory name, string memory kind) {
        bytes memory all = bytes(text);
        uint256 dot = all.length;
        for (uint256 k; k != all.length; ++k) if (all[k] == ".") dot = k;
        if (dot == all.length) return (text, "");
        return (string(all.slice(0, dot)), string(all.slice(dot + 1)));
    }

    function answer(string memory kind, string memory body, string memory cache)
        private pure returns (uint16, string memory, KeyValue[] memory headers)
    {
        headers = new KeyValue[](2);
        (headers[0], headers[1]) = (KeyValue("Content-Type", kind), KeyValue("Cache-Control", cache));
        return (200, body, headers);
    }

    function refused(uint16 code, string memory why) private pure returns (uint16, string memory, KeyValue[] memory headers) {
        headers = new KeyValue[](1);
        headers[0] = KeyValue("Content-Type", "text/plain");
        return (code, why, headers);
    }

    function check(address contract_) private view {
        if (contract_.code.length == 0) revert NoContract(contract_);
    }
}
