"""The page of the Creator.

- `server`: the command's server, its routes and what it forbids (`headers`).
- `page`: what is on the page; `panel`: the controls, made of the data of `..controls`; `shelf`, `dialogs`, `icons`.
- `live`: the wire between page and server; `visitor`: what a message does, and the picture that follows; `keys`.
- `mint`, by the visitor's own `wallet`, which is asked over the wire; `waiting`: what it has not answered.
- `visitors`: who is there; `unmet`: pages that nobody has opened.
- `assets`: the style, and the little that has to happen in the browser.
"""
