"""Whatever people do, in whatever order: what must always hold."""

from __future__ import annotations

import pytest

pytest.importorskip("pyrevm", reason="a chain with state needs it")

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule
from tools.tokens.launched import ALLOW_LIST, ICONS, LIMIT, PRICE, PUBLIC, RESERVE, launched
from tools.tokens.merkle import proof_of, root_of
from tools.tokens.world import ETHER, ZERO, Contract, Refused, account

from token_checks import succeeds

NAMES = ("alice", "bob", "carol", "dave")
PEOPLE = [account(name) for name in NAMES]
LISTED = {account("alice"): 3, account("bob"): 7, account("carol"): 2**256 - 1}
START = 1000 * ETHER

people = st.sampled_from(PEOPLE)
owners = st.sampled_from([account("owner"), account("owner"), *PEOPLE])
names = st.sampled_from(["genesis", "icons"])
quantities = st.sampled_from([1, 1, 2, 3, 5, LIMIT, 0, LIMIT + 1, 2**64, 2**256 - 1])
#: What is sent, beside what is due.
errors = st.sampled_from([0, 0, 0, 0, 0, 0, 0, 1, -1, PRICE])


class Sales(RuleBasedStateMachine):
    """Both collections at once, beside a model of who has which token and where the ether is."""

    @initialize()
    def begin(self) -> None:
        self.s = launched()
        self.world = self.s.world
        for person in PEOPLE:
            self.world.of(person).balance = START
        self.world.of(self.s.owner).balance = 0
        self.owner = self.s.owner
        self.phases = {"genesis": PUBLIC, "icons": PUBLIC}
        self.tokens: dict[str, list[str]] = {"genesis": [], "icons": []}
        self.rounds: list[int] = []
        self.kinds: list[int] = []
        self.spent: dict[tuple[str, str], int] = {}
        self.paid = dict.fromkeys(PEOPLE, 0)
        self.taken = {"genesis": 0, "icons": 0}
        self.fetched = 0
        self.reserve_minted = 0
        self.icons = [[0, 0] for _ in ICONS]
        self.seeds: dict[int, bytes] = {}
        self.revealed: set[int] = set()
        for contract in (self.s.genesis, self.s.icons):
            contract.send("setAllowList", root_of(LISTED), ZERO, sender=self.owner)

    # ---- what people do ----

    @rule(
        genesis=st.booleans(),
        person=people,
        icon=st.integers(0, 2),
        quantity=quantities,
        error=errors,
        listed=st.booleans(),
    )
    def mint(self, genesis: bool, person: str, icon: int, quantity: int, error: int, listed: bool) -> None:
        self._mint(genesis, person, icon, quantity, error, listed)

    @rule(genesis=st.booleans(), person=people, icon=st.integers(0, 1), quantity=st.integers(1, LIMIT))
    def buy(self, genesis: bool, person: str, icon: int, quantity: int) -> None:
        """As somebody does who reads what is possible before."""
        listed = self.phases["genesis" if genesis else "icons"] == ALLOW_LIST
        self._mint(genesis, person, icon, quantity, 0, listed)

    def _mint(self, genesis: bool, person: str, icon: int, quantity: int, error: int, listed: bool) -> None:
        name, which = ("genesis", ()) if genesis else ("icons", (icon,))
        _, supply, reserve, price = [*ICONS.values(), ("", 0, 0, PRICE)][2 if genesis else icon]
        if genesis:
            left = 1024 - (RESERVE - self.reserve_minted) - len(self.tokens[name])
        else:
            left = supply - reserve - self.icons[icon][0] if icon < len(ICONS) else 0
        value = max(min(quantity, 100) * price + error, 0)
        allowed = LISTED.get(person, 1)
        possible = (
            0 < quantity <= min(LIMIT, left)
            and value == quantity * price
            and self.phases[name] == (ALLOW_LIST if listed else PUBLIC)
            and (not listed or (person in LISTED and self.spent.get((name, person), 0) + quantity <= allowed))
            and self.world.balance(person) >= value
        )
        proof = proof_of(LISTED, person if person in LISTED else PEOPLE[0])
        function, more = ("mintWithProof", (allowed, proof)) if listed else ("mint", ())
        contract = self._contract(name)
        if not succeeds(possible, contract, function, *which, quantity, *more, sender=person, value=value):
            return
        if listed:
            self.spent[name, person] = self.spent.get((name, person), 0) + quantity
        if not genesis:
            self.icons[icon][0] += quantity
        self.paid[person] += value
        self.taken[name] += value
        self._add(name, person, quantity, icon)

    def _add(self, name: str, person: str, quantity: int, icon: int = 0) -> None:
        self.tokens[name] += [person] * quantity
        if name == "icons":
            self.kinds += [icon] * quantity
        else:
            self.rounds += [(self.world.number - self.s.genesis.call("firstBlock")) // 32] * quantity

    @rule(name=names, start=people, by=people, end=people, token=st.integers(0, 30), right=st.booleans())
    def transfer(self, name: str, start: str, by: str, end: str, token: int, right: bool) -> None:
        tokens = self.tokens[name]
        if right and token < len(tokens):
            start = by = tokens[token]
        possible = token < len(tokens) and tokens[token] == start == by
        if succeeds(possible, self._contract(name), "safeTransferFrom", start, end, token, sender=by):
            tokens[token] = end

    @rule(blocks=st.sampled_from([1, 5, 40, 200, 600]))
    def wait(self, blocks: int) -> None:
        self.world.mine(blocks)

    @precondition(lambda self: set(self.rounds) - self.revealed)
    @rule(data=st.data(), by=people)
    def reveal_tokens(self, data: st.DataObject, by: str) -> None:
        """A round that has tokens, as soon as the world's hashes can be read."""
        round_ = data.draw(st.sampled_from(sorted(set(self.rounds) - self.revealed)))
        self.world.mine(max(self.s.genesis.call("blockOf", round_) + 257 - self.world.number, 0))
        self.reveal(round_, by, other=False)

    @rule(round_=st.integers(0, 40), by=people, other=st.booleans())
    def reveal(self, round_: int, by: str, other: bool) -> None:
        """With the header of the block, or that of another."""
        block = self.s.genesis.call("blockOf", round_)
        # older blocks than 256, since the world's EVM has hashes of its own for the younger ones
        possible = block + 256 < self.world.number
        if not possible and block < self.world.number:
            return
        header = self.world.header(block + 1 if other else block) if possible else b""
        possible = possible and (not other or round_ in self.revealed)
        if succeeds(possible, self.s.genesis, "reveal", [round_], [header], sender=by):
            self.revealed.add(round_)

    # ---- what the owner does, or somebody who is not ----

    @rule(name=names, phase=st.sampled_from([PUBLIC, PUBLIC, ALLOW_LIST, 0, 3]), by=owners)
    def set_phase(self, name: str, phase: int, by: str) -> None:
        if succeeds(phase != 3 and by == self.owner, self._contract(name), "setPhase", phase, sender=by):
            self.phases[name] = phase

    @rule(to=people, quantity=quantities, by=owners)
    def mint_reserve(self, to: str, quantity: int, by: str) -> None:
        possible = 0 < quantity <= min(LIMIT, RESERVE - self.reserve_minted) and by == self.owner
        if succeeds(possible, self.s.genesis, "mintReserve", to, quantity, sender=by):
            self.reserve_minted += quantity
            self._add("genesis", to, quantity)

    @rule(to=people, quantity=st.integers(0, 3), icon=st.integers(0, 1))
    def mint_icon_reserve(self, to: str, quantity: int, icon: int) -> None:
        reserve = list(ICONS.values())[icon][2]
        possible = 0 < quantity <= reserve - self.icons[icon][1]
        if succeeds(possible, self.s.icons, "mintReserve", icon, to, quantity, sender=self.owner):
            self.icons[icon][1] += quantity
            self._add("icons", to, quantity, icon)

    @rule(name=names, by=owners)
    def withdraw(self, name: str, by: str) -> None:
        if succeeds(by == self.owner, self._contract(name), "withdraw", account("treasury"), sender=by):
            self.fetched += self.taken[name]
            self.taken[name] = 0

    # ---- what always holds ----

    @invariant()
    def supply(self) -> None:
        for name, tokens in self.tokens.items():
            assert self._contract(name).call("totalSupply") == len(tokens)
            assert self._contract(name).call("phase") == self.phases[name]
        assert len(self.tokens["genesis"]) <= 1024
        assert self.s.genesis.call("reserveMinted") == self.reserve_minted <= RESERVE
        left = 1024 - (RESERVE - self.reserve_minted) - len(self.tokens["genesis"])
        assert self.s.genesis.call("left") == left >= 0
        for icon, (sold, reserved) in enumerate(self.icons):
            found = self.s.icons.call("iconAt", icon)
            assert tuple(found[6:]) == (sold, reserved)
            assert sold + reserved <= found[4]

    @invariant()
    def owners(self) -> None:
        for name, tokens in self.tokens.items():
            contract = self._contract(name)
            for person in PEOPLE:
                assert contract.call("balanceOf", person) == tokens.count(person)
            for token in {0, len(tokens) // 2, len(tokens) - 1} & set(range(len(tokens))):
                assert contract.call("ownerOf", token) == tokens[token]

    @invariant()
    def ether(self) -> None:
        for name, taken in self.taken.items():
            assert self.world.balance(self._contract(name).address) == taken
        assert self.world.balance(account("treasury")) == self.fetched
        assert all(self.world.balance(person) == START - self.paid[person] for person in PEOPLE)
        assert sum(self.paid.values()) == sum(self.taken.values()) + self.fetched

    @invariant()
    def rounds_and_kinds(self) -> None:
        """They stay with the token."""
        for token in {0, len(self.rounds) // 3, len(self.rounds) - 1} & set(range(len(self.rounds))):
            assert self.s.genesis.call("roundOf", token) == self.rounds[token]
        for token in {0, len(self.kinds) // 3, len(self.kinds) - 1} & set(range(len(self.kinds))):
            assert self.s.icons.call("iconOf", token) == self.kinds[token]

    @invariant()
    def one_seed(self) -> None:
        """Each token has none, or one that never changes and that no other has."""
        for token, round_ in enumerate(self.rounds):
            if round_ in self.revealed and token not in self.seeds and len(self.seeds) < 6:
                self.seeds[token] = self.s.genesis.call("seedOf", token)
        for token, seed in self.seeds.items():
            assert self.s.genesis.call("seedOf", token) == seed
        assert len(set(self.seeds.values())) == len(self.seeds)
        hidden = [token for token, round_ in enumerate(self.rounds) if round_ not in self.revealed]
        for token in hidden[:1] + hidden[-1:]:
            with pytest.raises(Refused, match="NotRevealed"):
                self.s.genesis.call("seedOf", token)

    def _contract(self, name: str) -> Contract:
        return self.s.genesis if name == "genesis" else self.s.icons


TestSales = Sales.TestCase
TestSales.settings = settings(max_examples=10, stateful_step_count=40)
