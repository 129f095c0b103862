"""Whatever artists and buyers do, in whatever order: what must always hold of the editions."""

from __future__ import annotations

import copy
from dataclasses import astuple, dataclass

import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule
from tools.tokens.world import ETHER, account

from token_checks import succeeds
from tokens.test_editions import NOBODY, OPEN, _shown

PEOPLE = [account(name) for name in ("alice", "bob", "carol")]
START = 1000 * ETHER

people = st.sampled_from(PEOPLE)
numbers = st.integers(0, 4)
quantities = st.sampled_from([1, 1, 2, 3, 100, 0, 101, 2**32 + 1, 2**256 - 1])
#: What is sent, beside what is due.
errors = st.sampled_from([0, 0, 0, 0, 0, 0, 1, -1])


@dataclass
class Model:
    """An edition, as the contract answers it."""

    artist: str
    price: int
    supply: int
    minted: int
    settled: int
    closed: bool
    royalty: int
    scale: int
    model: bool
    scene: str
    name: str


class Show(RuleBasedStateMachine):
    """The collection, beside a model of who has which token and where the ether is."""

    @initialize()
    def begin(self) -> None:
        show = copy.deepcopy(_shown())
        self.scene, self.contract = show.scene, show.s.world.deploy("Editions", show.s.studio)
        self.world = show.s.world
        for person in PEOPLE:
            self.world.of(person).balance = START
        self.world.of(NOBODY).balance = 0
        self.editions: list[Model] = []
        #: Owner and edition of each token.
        self.tokens: list[tuple[str, int]] = []
        self.paid = dict.fromkeys(PEOPLE, 0)
        self.fetched = 0

    @rule(
        artist=people,
        price=st.sampled_from([0, 1, ETHER // 100, 2 * ETHER]),
        supply=st.sampled_from([1, 2, 5, 150, OPEN, 0]),
        copies=st.sampled_from([0, 0, 1, 3, 101]),
        royalty=st.sampled_from([0, 250, 1000, 1001]),
    )
    def add(self, artist: str, price: int, supply: int, copies: int, royalty: int) -> None:
        edition = len(self.editions)
        model = Model(artist, price, supply, copies, copies, False, royalty, 1, False, self.scene, f"No. {edition}")
        possible = supply > 0 and copies <= min(supply, 100) and royalty <= 1000
        terms = (model.name, self.scene, 1, False, price, supply, royalty, copies)
        if succeeds(possible, self.contract, "add", *terms, sender=artist):
            self.editions.append(model)
            self.tokens += [(artist, edition)] * copies

    @rule(person=people, edition=numbers, quantity=quantities, error=errors)
    def mint(self, person: str, edition: int, quantity: int, error: int) -> None:
        model = self.editions[edition] if edition < len(self.editions) else None
        value = max(min(quantity, 101) * (model.price if model else 1) + error, 0)
        possible = (
            model is not None
            and 0 < quantity <= min(100, model.supply - model.minted)
            and value == quantity * model.price
            and not model.closed
            and self.world.balance(person) >= value
        )
        if succeeds(possible, self.contract, "mint", edition, quantity, sender=person, value=value):
            self.editions[edition].minted += quantity
            self.paid[person] += value
            self.tokens += [(person, edition)] * quantity

    @precondition(lambda self: self.editions)
    @rule(number=numbers, person=people)
    def buy(self, number: int, person: str) -> None:
        """As somebody does who reads what is possible before."""
        self.mint(person, number % len(self.editions), 1, 0)

    @rule(person=people, edition=numbers)
    def close(self, person: str, edition: int) -> None:
        model = self.editions[edition] if edition < len(self.editions) else None
        possible = model is not None and model.artist == person and not model.closed
        if succeeds(possible, self.contract, "close", edition, sender=person):
            self.editions[edition].closed = True

    @rule(person=people, editions=st.lists(numbers, max_size=3), mine=st.booleans())
    def withdraw(self, person: str, editions: list[int], mine: bool) -> None:
        if mine:
            editions = [number for number, model in enumerate(self.editions) if model.artist == person]
        models = [self.editions[number] for number in editions if number < len(self.editions)]
        possible = len(models) == len(editions) and all(model.artist == person for model in models)
        if not succeeds(possible, self.contract, "withdraw", editions, NOBODY, sender=person):
            return
        for model in models:
            self.fetched += (model.minted - model.settled) * model.price
            model.settled = model.minted

    @precondition(lambda self: self.tokens)
    @rule(number=st.integers(0, 999), end=people, by=people)
    def transfer(self, number: int, end: str, by: str) -> None:
        token = number % len(self.tokens)
        owner, edition = self.tokens[token]
        if succeeds(by == owner, self.contract, "transferFrom", owner, end, token, sender=by):
            self.tokens[token] = end, edition

    @invariant()
    def editions_are_as_they_were_added(self) -> None:
        """Nothing but the counts and `closed` changes, and those as they must."""
        assert self.contract.call("editionCount") == len(self.editions)
        for number, model in enumerate(self.editions):
            assert self.contract.call("editionAt", number) == astuple(model)
            assert model.settled <= model.minted <= model.supply
            assert sum(edition == number for _, edition in self.tokens) == model.minted

    @invariant()
    def ether(self) -> None:
        due = [(model.minted - model.settled) * model.price for model in self.editions]
        assert [self.contract.call("proceeds", number) for number in range(len(due))] == due
        assert self.world.balance(self.contract.address) == sum(due) == sum(self.paid.values()) - self.fetched
        assert self.world.balance(NOBODY) == self.fetched
        assert all(self.world.balance(person) == START - self.paid[person] for person in PEOPLE)

    @invariant()
    def tokens_stay_what_they_are(self) -> None:
        assert self.contract.call("totalSupply") == len(self.tokens)
        for person in PEOPLE:
            assert self.contract.call("balanceOf", person) == sum(owner == person for owner, _ in self.tokens)
        for token in {0, len(self.tokens) // 3, len(self.tokens) - 1} & set(range(len(self.tokens))):
            owner, edition = self.tokens[token]
            assert self.contract.call("ownerOf", token) == owner
            assert self.contract.call("editionOf", token) == edition


TestEditions = Show.TestCase
TestEditions.settings = settings(max_examples=10, stateful_step_count=30)
