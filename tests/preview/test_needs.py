"""Files of tokens that load from outside, or use what marketplaces leave out."""

from __future__ import annotations

import json
import time
from typing import Any
from urllib.parse import quote

import pytest

from shackled.preview._document import judge, judge_picture

XMLNS = "xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink'"
LOGO = "https://a.io/a.png"


def svg(inner: str, head: str = "") -> str:
    return f"{head}<svg {XMLNS}>{inner}</svg>"


NESTED = "data:image/svg+xml," + quote(svg(f"<image href='{LOGO}'/>"))


def problems(**fields: Any) -> list[str]:
    """Return what is wrong with a token that has these fields."""
    token = {"name": "One"} | fields
    if "image_data" not in fields:
        token = {"image": "data:image/svg+xml," + quote(svg(""))} | token
    return judge("data:application/json," + quote(json.dumps(token))).problems


def of_picture(content: str) -> list[str]:
    return problems(image="data:image/svg+xml," + quote(content))


def of_page(content: str | bytes, kind: str = "data:text/html") -> list[str]:
    return problems(animation_url=f"{kind},{quote(content)}")


@pytest.mark.parametrize(
    ("content", "named"),
    [
        (svg(f"<use href='{LOGO}#a'/>"), f"{LOGO}#a"),
        (svg("<use xlink:href='sprites.svg#a'/>"), "sprites.svg#a"),
        (svg("<rect fill='url( \"//a.io/p.svg#p\")'/>"), "//a.io/p.svg#p"),
        (svg("<rect style='filter:url(ipfs://f/f.svg#f)'/>"), "ipfs://f/f.svg#f"),
        (svg("<style>@import 'https://a.io/a.css'; @import url(b.css);</style>"), "https://a.io/a.css, b.css"),
        (svg("<style><![CDATA[@font-face{src:URL('https://a.io/f.woff')}]]></style>"), "https://a.io/f.woff"),
        (svg("", "<?xml-stylesheet type='text/css' href='https://a.io/s.css'?>"), "https://a.io/s.css"),
        (svg("".join(f"<use href='{n}.svg'/>" for n in range(5))), "0.svg, 1.svg, 2.svg and 2 more"),
        (svg("<textPath href='ar://a'/>" * 2), "ar://a"),
    ],
)
def test_pictures_that_load_from_outside(content: str, named: str) -> None:
    line = f"loads {named} from outside: put it into the SVG"
    assert of_picture(content) == [f"image {line}"]
    assert problems(image_data=content) == [f"image_data {line}"]
    assert judge_picture(content).problems == judge_picture(content.encode()).problems == [f"the picture {line}"]
    # also where scripts run
    assert problems(animation_url="data:image/svg+xml," + quote(content)) == [f"animation_url {line}"]


COMPLETE = [
    svg("<a href='https://a.io'><text>a</text></a><use href='#a'/><rect fill='url(#g)' filter=''/>"),
    svg("<style>@namespace url(http://n/); /* url(https://a.io) */ a{src:url(data:font/woff2,A)}</style>"),
    svg("<metadata>https://a.io</metadata><!-- <script/> --><animate attributeName='x'/>"),
    svg("", '<!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">'),
]
COMPLETE_PAGES = [
    "<a href='https://a.io'>a</a><link rel=canonical href='https://a.io'><img src='data:,'>",
    "<script>// by https://a.io\nd.createElementNS('http://www.w3.org/2000/svg', 'svg')</script> from '//a'",
    "<script>import('data:text/javascript,1'); fetch('blob:a')</script><svg><use href='#a'/></svg>",
]


def test_files_that_have_all_they_need() -> None:
    assert [of_picture(each) for each in COMPLETE] == [[]] * len(COMPLETE)
    assert [of_page(each) for each in COMPLETE_PAGES] == [[]] * len(COMPLETE_PAGES)


@pytest.mark.parametrize(
    ("inner", "message"),
    [
        ("<script>alert(1)</script>", "has a script, which pictures do not run"),
        ("<rect onclick='a()'/>", "has a script, which pictures do not run"),
        ("<a href='javascript:a()'/>", "has a script, which pictures do not run"),
        ("<foreignObject><p xmlns='http://www.w3.org/1999/xhtml'>a</p></foreignObject>", "has <foreignObject>, which"),
        ("<video xmlns='http://www.w3.org/1999/xhtml'/>", "has <video>, which marketplaces remove"),
        ("<image href='data:image/png;base64,AA'/>", "is an SVG with a picture in it, which marketplaces do not show"),
        ("<filter><feImage href='#a'/></filter>", "is an SVG with a picture in it, which marketplaces do not show"),
    ],
)
def test_what_marketplaces_leave_out(inner: str, message: str) -> None:
    (problem,) = of_picture(svg(inner))
    assert problem.startswith(f"image {message}")
    # a page shows them all
    assert problems(animation_url="data:image/svg+xml," + quote(svg(inner))) == []


def test_pictures_within_pictures() -> None:
    outside, inside = of_picture(svg(f"<image href='{LOGO}'/>"))
    assert outside == f"image loads {LOGO} from outside: put it into the SVG"
    assert "return the picture itself" in inside
    assert of_picture(svg(f'<use href="{NESTED}"/>')) == [outside]
    # a function such as `svg` may be meant for pages
    assert judge_picture(svg("<image href='data:image/png;base64,AA'/>")).problems == []


@pytest.mark.parametrize(
    ("content", "named"),
    [
        ("<script src=https://cdn.io/three.js></script>", "https://cdn.io/three.js"),
        ("<link rel='STYLESHEET' href='a.css'>", "a.css"),
        ("<img srcset='data:image/png;base64,AA 1x,b.png 2x' src='#'>", "b.png"),
        ("<video poster=p.jpg></video><object data='o.svg'></object>", "p.jpg, o.svg"),
        ("<body style='background:url(b.png)'>", "b.png"),
        ("<style>@import url('https://a.io/a.css')</style>", "https://a.io/a.css"),
        ("<script type=importmap>{'imports':{'three':\"https://cdn.io/t.js\"}}</script>", "https://cdn.io/t.js"),
        ("<script type=module>import * as T from 'https://cdn.io/t.js'</script>", "https://cdn.io/t.js"),
        ("<script>x = await fetch(`https://a.io/api`)</script>", "https://a.io/api"),
        ("<script>r.open('GET', '//a.io/r')</script>", "//a.io/r"),
        ("<svg><use xlink:href='a.svg#a'/></svg>", "a.svg#a"),
        ('<script>new Image().src = "ipfs://q"</script>', "ipfs://q"),
        (f'<img src="{NESTED}">', LOGO),
    ],
)
def test_pages_that_load_from_outside(content: str, named: str) -> None:
    assert of_page(f"<html><meta charset=utf-8>{content}</html>") == [
        f"animation_url loads {named} from outside: put it into the page"
    ]


@pytest.mark.parametrize(
    ("content", "kind", "is_declared"),
    [
        ("<p>\u201c\u2014".encode(), "data:text/html", False),
        ("<p>\u201c\u2014".encode(), "data:text/html;charset=UTF-8", True),
        ("<head><meta charset='utf-8'><p>\u2014".encode(), "data:text/html", True),
        ("<meta http-equiv=Content-Type content='text/html; charset=utf-8'>\u2014".encode(), "data:text/html", True),
        (b"<!--" + b" " * 1024 + "--><meta charset='utf-8'>\u2014".encode(), "data:text/html", False),
        ("\ufeff<p>\u2014".encode(), "data:text/html", True),
        (b"<p>&mdash;", "data:text/html", True),
    ],
)
def test_character_encodings_of_pages(content: bytes, kind: str, is_declared: bool) -> None:
    line = "animation_url has letters beyond ASCII but no charset: begin its head with <meta charset='utf-8'>"
    assert of_page(content, kind) == ([] if is_declared else [line])


def test_models_that_load_from_outside() -> None:
    document = {"buffers": [{"uri": "data:,"}, {"uri": "a.bin"}], "images": [{"uri": LOGO}, {"bufferView": 0}]}
    line = f"animation_url loads a.bin, {LOGO} from outside: put it into the model"
    text = json.dumps(document).encode()
    assert of_page(text, "data:model/gltf+json") == [line]
    glb = b"glTF\2\0\0\0" + (20 + len(text)).to_bytes(4, "little") + len(text).to_bytes(4, "little") + b"JSON" + text
    assert of_page(glb, "data:model/gltf-binary") == [line]
    for broken in (b"[]", b"{", b'{"images":[0]}', b'{"buffers":1}'):
        assert of_page(broken, "data:model/gltf+json") == []


def test_types_that_the_content_does_not_have() -> None:
    for kind, content, real in (
        ("image/png", b"\xff\xd8\xff", "image/jpeg"),
        ("image/gif", svg("").encode(), "image/svg+xml"),
        ("image/svg+xml", b"\x89PNG\r\n", "image/png"),
    ):
        (problem,) = problems(image=f"data:{kind},{quote(content)}")
        assert problem == f"image has the type {kind}, but is {real}: write data:{real}"
    (problem,) = problems(animation_url="http://a.io/1")
    assert "animation_url is not on the chain" in problem


@pytest.mark.parametrize(
    ("sizes", "named"),
    [
        ("width='0' height='0'", "width"),
        ("width='10' height=' 0.00px '", "height"),
        ("width='0%'", "width"),
        ("viewBox='0 0 0 10'", "viewBox width"),
        ("width='10' viewBox='0,0,10,-.0'", "viewBox height"),
    ],
)
def test_svgs_that_show_nothing(sizes: str, named: str) -> None:
    empty, shown = (f"<svg {each} {XMLNS}><rect width='0'/></svg>" for each in (sizes, sizes.replace("0", "5")))
    assert of_picture(empty) == [f"image is an SVG of {named} 0, which shows nothing"]
    assert problems(animation_url="data:image/svg+xml," + quote(empty)) != []
    assert of_picture(shown) == []


@pytest.mark.parametrize(
    ("script", "named"),
    [
        ("localStorage.x=1", "localStorage"),
        ("const s = window.sessionStorage;", "sessionStorage"),
        ("if (localStorage['seen']) draw()", "localStorage"),
        ("let a = 'https://a.io';indexedDB.open('a')", "indexedDB"),
        ("document.cookie = 'a=1'", "document.cookie"),
        ("try { draw() } catch {} localStorage?.clear()", "localStorage"),
        ("try { if (a) { localStorage.x = 1 } } catch {}", None),
        ("/* localStorage.x */ draw() // localStorage.x", None),
        ("const myLocalStorage = {}; show('no localStorage here')", None),
    ],
)
def test_pages_that_keep_something_in_the_browser(script: str, named: str | None) -> None:
    line = f"animation_url uses {named}, which throws an error in the sandbox of marketplaces"
    for found in (
        of_page(f"<body><script>{script}</script>"),
        problems(animation_url="data:image/svg+xml," + quote(svg(f"<script><![CDATA[{script}]]></script>"))),
    ):
        assert [each.partition(":")[0] for each in found] == [line] * (named is not None)


def test_hostile_files_take_no_time() -> None:
    """Regular expressions that try many ways would take minutes."""
    begun = time.process_time()
    for part in (
        "url( ",
        "/*",
        "import ",
        "open('A',",
        "<?xml-stylesheet ",
        "' , a",
        " a,",
        "try{",
        "try{{}",
        "{}",
        "=  ",
        "//",
    ):
        many = part * 20_000
        for head in ("<style>", '<img srcset="', "<script>"):
            of_page(head + many)
        judge_picture(svg(f"<style><![CDATA[{many}]]></style>"))
    deep = svg("")
    for _ in range(12):
        deep = svg(f'<use href="data:image/svg+xml,{quote(deep)}"/>')
    assert judge_picture(deep).problems == []
    assert time.process_time() - begun < 10
