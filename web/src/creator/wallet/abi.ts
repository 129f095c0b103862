// What the page asks of collections.

import { parseAbi } from "viem";

export const TOKENS = parseAbi([
    "function name() view returns (string)",
    "function ownerOf(uint256) view returns (address)",
    "function tokenURI(uint256) view returns (string)",
    "function totalSupply() view returns (uint256)",
    "event Transfer(address indexed from, address indexed to, uint256 indexed tokenId)",
]);
export const EDITIONS = parseAbi([
    "struct Edition { address artist; uint96 price; uint32 supply; uint32 minted; uint32 settled; bool closed; uint16 royalty; uint8 scale; bool model; address scene; string name; }",
    "function editionAt(uint256) view returns (Edition)",
    "function editionCount() view returns (uint256)",
    "function editionURI(uint256) view returns (string)",
    "function left(uint256) view returns (uint256)",
    "function mint(uint256, uint256) payable",
    "event EditionAdded(uint256 indexed edition, address indexed artist, address indexed scene, string name, uint256 scale, bool model, uint256 price, uint256 supply, uint256 royalty)",
]);
export const ICONS = parseAbi([
    "struct Icon { string name; address scene; uint8 scale; uint96 price; uint32 supply; uint32 reserve; uint32 sold; uint32 reserveMinted; }",
    "function phase() view returns (uint8)",
    "function iconCount() view returns (uint256)",
    "function iconAt(uint256) view returns (Icon)",
    "function left(uint256) view returns (uint256)",
    "function mint(uint256, uint256) payable",
]);
export const GENESIS = parseAbi([
    "function phase() view returns (uint8)",
    "function price() view returns (uint256)",
    "function left() view returns (uint256)",
    "function mint(uint256) payable",
    "function hiddenRounds(uint256, uint256) view returns (uint256[])",
    "function blockOf(uint256) view returns (uint256)",
    "function hashOf(uint256) view returns (bytes32)",
    "function randomnessOf(uint256) view returns (bytes32)",
    "function reveal(uint256[], bytes[])",
]);
