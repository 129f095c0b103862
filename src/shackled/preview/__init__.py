"""The preview of a token contract: compiled, deployed into the embedded EVM, and drawn token by token.

`_project` finds the compiler, `_arguments` reads values for the constructor and calls, `_world` deploys and calls,
`_document` judges what a token returns, `_preview` does all of it for one state of the sources, and `_server` shows it
on a page that follows the sources.
"""
