// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

/// @notice A scene of which anybody can mint tokens. Only `minted`, `settled` and `closed` ever change.
/// @param artist Who added it, receives what its tokens cost, and is named for royalties.
/// @param price Of each token, in wei.
/// @param supply The most tokens that there will ever be; 2^32 - 1 where the edition is open.
/// @param minted How many tokens there are.
/// @param settled How many of these are paid out: those whose price the artist has withdrawn, and the artist's own copies.
/// @param closed Whether no more tokens can be minted.
/// @param royalty What the artist is to be paid of each resale, in hundredths of a percent.
/// @param scale How many pixels each pixel of the scene becomes in `tokenURI`, both ways.
/// @param scene Where the studio keeps the scene.
/// @param name What it is called.
struct Edition {
    address artist;
    uint96 price;
    uint32 supply;
    uint32 minted;
    uint32 settled;
    bool closed;
    uint16 royalty;
    uint8 scale;
    address scene;
    string name;
}
