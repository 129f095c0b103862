// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @notice A scene for which anyone can mint tokens. Only `minted`, `settled` and `closed` ever change.
/// @param artist The account that added the edition and receives its proceeds and royalties.
/// @param price The price of a token, in wei.
/// @param supply The maximum number of tokens; 2^32 - 1 if the edition is open.
/// @param minted The number of tokens minted.
/// @param settled The number of tokens without outstanding proceeds: the artist's free copies, and those whose price was withdrawn.
/// @param closed Whether minting has ended.
/// @param royalty The royalty of a resale, in basis points.
/// @param scale The enlargement of the picture in `tokenURI`: each pixel becomes a square of `scale` x `scale` pixels.
/// @param model Whether the metadata contains the scene as a GLB model, in `animation_url`.
/// @param scene The pointer to the scene, as the Studio returned it.
/// @param name The name of the edition.
struct Edition {
    address artist;
    uint96 price;
    uint32 supply;
    uint32 minted;
    uint32 settled;
    bool closed;
    uint16 royalty;
    uint8 scale;
    bool model;
    address scene;
    string name;
}
