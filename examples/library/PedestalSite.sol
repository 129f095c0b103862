// SPDX-License-Identifier: MIT
pragma solidity ^0.8.25;

import {ILibrary} from "shackled-contracts/interfaces/ILibrary.sol";
import {IStudio} from "shackled-contracts/interfaces/IStudio.sol";
import {Pedestal} from "./Pedestal.sol";

/// @notice Serves the pictures at web3:// URLs: web3://ADDRESS/crown, and links to all of them at /.
contract PedestalSite is Pedestal {
    struct KeyValue {
        string key;
        string value;
    }

    constructor(ILibrary items_, IStudio studio_) Pedestal(items_, studio_) {}

    /// @notice Selects ERC-5219 mode (ERC-4804).
    function resolveMode() external pure returns (bytes32) {
        return "5219";
    }

    /// @notice Responds to a request, given by the segments of the path and the query parameters.
    function request(string[] calldata resource, KeyValue[] calldata)
        external
        view
        returns (uint16 status, string memory body, KeyValue[] memory headers)
    {
        headers = new KeyValue[](1);
        if (resource.length == 0) {
            headers[0] = KeyValue("Content-Type", "text/html");
            return (200, links(), headers);
        }
        try items.isStored(resource[0]) returns (bool isStored) {
            if (isStored) {
                headers[0] = KeyValue("Content-Type", "image/png");
                return (200, string(studio.drawPNG(onPedestal(resource[0]), 4)), headers);
            }
        } catch {}
        headers[0] = KeyValue("Content-Type", "text/plain");
        return (404, "There is no such item, or it is not stored yet.", headers);
    }

    function links() private view returns (string memory html) {
        string[] memory names = items.names();
        for (uint256 k; k != names.length; ++k) {
            html = string.concat(html, '<p><a href="/', names[k], '">', names[k], "</a></p>");
        }
    }
}
