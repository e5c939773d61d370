"""The search behind an identification: locate the impacts, fit everything, take the noise from what
is left, again.
"""

from __future__ import annotations

import numpy

from contact_sim_pkg.identify.contact.lasting import (
    ContactEvent,
    lasting_note,
    locate,
    nothing_to_identify_from,
    with_steps,
)
from contact_sim_pkg.identify.contact.linearised import Linearised
from contact_sim_pkg.identify.contact.noise import FREE_MOTION_MISSING, ContactNote, NoteKind, from_residuals, limited
from contact_sim_pkg.identify.contact.slides import with_slides
from contact_sim_pkg.identify.contact.stacked import ParameterEstimate, estimate
from contact_sim_pkg.identify.errors import IdentificationError
from contact_sim_pkg.identify.motion.flight import plain_motion, state_at
from contact_sim_pkg.identify.motion.rotation import Array
from contact_sim_pkg.identify.motion.segments import LONGEST_IMPACT, SHORTEST_FLIGHT, Segments, gap_uncertainty
from contact_sim_pkg.identify.motion.states import SampleNoise
from contact_sim_pkg.identify.problem import ContactSpan, IdentificationProblem, pressed, sweep
from contact_sim_pkg.identify.turning import gap_deviation
from contact_sim_pkg.identify.warnings import agreeing, contradicts

__all__ = ["Search"]

ROUNDS = 5
SETTLED = 0.01  # change of the noise that ends the rounds, relative
MISSED = 3.0  # times the deviations of the two: how far two flights may miss each other at an impact
BESIDE_SOFT = (
    1e-9  # of the largest value: noise beside contacts that last, so that their information is not lost in the rank
)
CLEAR = 5.0  # times its deviation: a miss against the impulse, of an impact that lasts
FAR = 6.0  # times its deviation: a gap that is one
FAINT = 1e3  # times its size: standard deviation of 1/m up to which it is fitted, though not identified
WORSE = 5.0  # times the noise of the others: what is no flight


class Search:
    """Rounds of: locate the impacts, fit everything, take the noise from what is left."""

    def __init__(
        self,
        problem: IdentificationProblem,
        parts: Segments,
        noise: SampleNoise | None,
        starts: list[Array],
        scale: Array,
    ) -> None:
        """``starts``: parameters to begin with, of which those that the flights follow best are
        taken; ``scale``: their sizes.
        """
        self.noise = None if noise is None else limited(noise, problem.states)
        self.starts, self.scale, self.parts = starts, scale, parts
        self.start = starts[-1]
        whole = [flight for flight in parts.flights if flight[1] - flight[0] + 1 >= SHORTEST_FLIGHT]
        self.problem = problem._replace(flights=whole, noise=self.noise or problem.noise)
        self.notes: dict[int, ContactNote] = {}  # of contacts that are not used, by their place in parts.contacts
        self.places: list[int] = []  # of the contacts that are used
        self.contradicting: set[int] = set()  # places of contacts that contradict the others
        self.lasting: dict[int, ContactNote] = {}  # of contacts of many intervals, by place

    def run(self) -> ParameterEstimate:
        """All rounds."""
        for place, (first, last) in enumerate(self.parts.contacts):
            if last - first + 1 > LONGEST_IMPACT:
                self.notes[place] = self.lasting[place] = lasting_note(self.problem, first, last)
        # Without flights the steps of lasting contacts are all there is
        if not self.problem.flights:
            self.problem = with_slides(with_steps(self.problem, self.parts), self.parts)
        if not self.problem.flights:
            raise IdentificationError(nothing_to_identify_from(self.problem, self.lasting.values()))
        if self.problem.contacts:
            return estimate(self.problem, self.start, self.scale)
        found = self.free = self._without_false_flights(self._flights_alone())
        # The noise decides which contacts count, the fit shows the noise: until both agree
        for _ in range(ROUNDS):
            self._update_noise(found)
            before = self.problem.noise
            self._locate(found)
            found = self._fitted(found)
            if all(abs(new / old - 1.0) < SETTLED for new, old in zip(self._seen(found), before, strict=True)):
                break
        if found.directions.rank < self.problem.model.unknowns:
            found = self._with_steps(found)
        return self._with_faint_mass(found)

    @property
    def flights(self) -> int:
        """Flights of more than a sample."""
        return sum(last > first for first, last in self.problem.flights)

    def _flights_alone(self) -> ParameterEstimate:
        """The fit of the flights without contacts from the start that serves it best, which is
        kept.
        """
        best, least, failure = None, numpy.inf, None
        for start in self.starts:
            try:
                found = estimate(self.problem, start, self.scale)
            except IdentificationError as error:
                failure = error
                continue
            left = sum(float(numpy.sum(rest[:, 3:] ** 2)) for rest in found.residuals)
            if best is None or (found.converged and left < least):
                best, least, self.start = found, left, start
        if best is None:
            raise failure or IdentificationError("there is nothing to begin with")
        return best

    def _fitted(self, found: ParameterEstimate) -> ParameterEstimate:
        """Fit to the contacts; where they contradict each other, to those that agree."""
        scale = self._scale(found)
        try:
            fit = estimate(self.problem, found.parameters, scale, found.flights)
        except IdentificationError:
            if not self._without_contradicting(half=True):
                raise
        else:
            if not (contradicts(fit) and self._without_contradicting(half=False)):
                return fit
        return estimate(self.problem, self.free.parameters, scale, self.free.flights)

    def _without_contradicting(self, *, half: bool) -> bool:
        """Leave out contacts that contradict the others, judged where the flights alone are;
        whether there are any.
        """
        linear = Linearised(self.problem, self.free.parameters, self.free.flights, self.scale)
        kept = agreeing(linear, len(self.contradicting), half=half)
        if len(kept) == len(self.places):
            return False
        out = [place for number, place in enumerate(self.places) if number not in kept]
        for place in out:
            self._refuse(place, ContactNote(NoteKind.CONTRADICTS))
        self.contradicting.update(out)
        self.places = [self.places[number] for number in kept]
        self.problem = self.problem._replace(contacts=[self.problem.contacts[number] for number in kept])
        return True

    def _seen(self, found: ParameterEstimate) -> SampleNoise:
        return self.noise or from_residuals(found.residuals, self.problem.states)

    def _update_noise(self, found: ParameterEstimate) -> None:
        self.problem = self.problem._replace(noise=self._seen(found))

    def _scale(self, found: ParameterEstimate) -> Array:
        """Sizes of the parameters; that of 1/m follows its estimate."""
        scale = self.scale.copy()
        if (
            self.problem.model.with_mass
            and not abs(found.directions.missing[:, -1:]).any()
            and found.parameters[-1] > 0.0
        ):
            scale[-1] = found.parameters[-1]
        return scale

    def _with_faint_mass(self, found: ParameterEstimate) -> ParameterEstimate:
        """Fit a mass that noise hides along with the rest, so that what is known besides keeps its
        number.

        Its size is taken FAINT times as large; where it is still not identified, all stays as it
        is.
        """
        if not self.problem.model.with_mass or not abs(found.directions.missing[:, -1:]).any():
            return found
        scale = found.scale.copy()
        scale[-1] *= FAINT
        wider = estimate(self.problem, found.parameters, scale, found.flights)
        return wider if wider.converged and wider.directions.rank > found.directions.rank else found

    def _without_false_flights(self, found: ParameterEstimate) -> ParameterEstimate:
        """Leave out runs that no flight fits, such as a rest that hides in the noise."""
        if len(self.problem.flights) < 2:
            return found
        spreads = numpy.array([float(numpy.sqrt(numpy.mean(rest[:, 3:6] ** 2))) for rest in found.residuals])
        limit = WORSE * max(float(numpy.median(spreads)), self.problem.noise.velocity)
        kept = [flight for flight, spread in zip(self.problem.flights, spreads, strict=True) if spread <= limit]
        if len(kept) == len(self.problem.flights):
            return found
        self.problem = self.problem._replace(flights=kept)
        return estimate(self.problem, self.start, self.scale)

    def _locate(self, found: ParameterEstimate) -> None:
        """Find instant and point of each impact on the flight before it."""
        contacts, self.places = [], []
        for place, (first, last) in enumerate(self.parts.contacts):
            if place in self.contradicting:
                continue
            before, after = self._neighbours(first, last)
            if before is None or after is None:
                if before is not None and place in self.lasting:
                    self._touch(found, place, before, (first, last))
                self._refuse(place, ContactNote(NoteKind.NO_FLIGHT_BESIDE, {"samples": SHORTEST_FLIGHT}))
            else:
                contact = self._contact(found, place, before, after, (first, last))
                if contact is not None:
                    contacts.append(contact)
                    self.places.append(place)
        # A sweep is as exact as the samples, which rounding bounds
        contacts = self._without_doubles(contacts)
        self.problem = self.problem._replace(contacts=contacts)
        if any(contact.sweep is not None for contact in contacts):
            noise = limited(self.problem.noise, self.problem.states, BESIDE_SOFT)
            self.problem = self.problem._replace(noise=noise)

    def _without_doubles(self, contacts: list[ContactSpan]) -> list[ContactSpan]:
        """Where most contacts are instants, one that seems to last between two samples is more than
        one impact.
        """
        lasting = sum(contact.sweep is not None for contact in contacts)
        if not 0 < lasting < len(contacts) - lasting:
            return contacts
        kept = [contact.sweep is None or contact.sweep.samples > 0 for contact in contacts]
        for place, keeps in zip(self.places, kept, strict=True):
            if not keeps:
                self._refuse(place, ContactNote(NoteKind.DOUBLE_IMPACT))
        self.places = [place for place, keeps in zip(self.places, kept, strict=True) if keeps]
        return [contact for contact, keeps in zip(contacts, kept, strict=True) if keeps]

    def _contact(
        self, found: ParameterEstimate, place: int, before: int, after: int, interval: tuple[int, int]
    ) -> ContactSpan | None:
        """One contact between two flights, or None and a note: at an instant where they meet, else
        as one that lasts.
        """
        touch = self._touch(found, place, before, interval)
        if not touch.found:
            if abs(touch.gap) <= FAR * gap_deviation(self.problem, before):
                self._refuse(place, ContactNote(NoteKind.FLIGHT_TOO_SHORT))
                return None
            self._refuse(place, ContactNote(NoteKind.NOTHING_TOUCHED, {"gap": touch.gap}))
            return None
        if touch.together > 1:
            self._refuse(place, ContactNote(NoteKind.SEVERAL_CORNERS, {"corners": touch.together}))
            return None
        # An impact: both flights meet at the instant of contact
        miss = self._miss(found, before, after, touch.time)
        if not miss and place not in self.lasting:
            self.notes.pop(place, None)
            return ContactSpan(before, after, touch.time, touch.time, touch.point, located=True)
        # A contact that lasts: from the touch before to the release behind it
        release = self._root(found, after, interval, leaving=True)
        uncertainty = gap_uncertainty(self.problem.shape, (self.problem.noise.position, self.problem.noise.rotation))
        lasts = release.found and release.point == touch.point and release.together == 1 and release.time > touch.time
        if not (lasts and pressed(self.problem, touch.point, touch.time, release.time, uncertainty)):
            self._refuse(place, ContactNote(NoteKind.FLIGHTS_MISS, {"miss": miss}))
            return None
        self.notes.pop(place, None)
        ends = [
            state_at(found.flights[number], found.parameters, self.problem.model, root.time)
            for number, root in ((before, touch), (after, release))
        ]
        swept = sweep(self.problem, touch.point, *ends)
        return ContactSpan(before, after, touch.time, release.time, touch.point, sweep=swept)

    def _touch(self, found: ParameterEstimate, place: int, flight: int, interval: tuple[int, int]) -> ContactEvent:
        """Where a contact begins: found, what goes below the ground there presses into it."""
        touch = self._root(found, flight, interval, leaving=False)
        note = self.lasting.get(place)
        if touch.found and note is not None and note.kind in FREE_MOTION_MISSING:
            self.lasting[place] = ContactNote(NoteKind.PRESSED_IN)
        return touch

    def _refuse(self, place: int, note: ContactNote) -> None:
        """Keep the reason why a contact is not used; the note of a lasting one stays."""
        self.notes[place] = self.lasting.get(place, note)

    def _root(self, found: ParameterEstimate, flight: int, interval: tuple[int, int], *, leaving: bool) -> ContactEvent:
        """Where a flight meets the ground at a contact."""
        problem, time = self.problem, self.problem.states.time
        begin, end, count = float(time[interval[0]]), float(time[interval[1] + 1]), interval[1] - interval[0] + 1
        slack = (end - begin) * min(0.5, LONGEST_IMPACT / count)
        start = 0.5 * (begin + end) if count <= LONGEST_IMPACT else end if leaving else begin
        return locate(
            flight=found.flights[flight],
            parameters=found.parameters,
            model=problem.model,
            shape=problem.shape,
            ground=problem.ground,
            bounds=(begin - slack, end + slack),
            start=start,
            deviation=gap_deviation(self.problem, flight),
            leaving=leaving,
        )

    def _miss(self, found: ParameterEstimate, before: int, after: int, time: float) -> float:
        """How far two flights miss each other at an impact, [m]; 0 where they meet within the
        noise.

        One that lasts separates them against its impulse, by half the way of that meanwhile: a far
        smaller miss shows it.
        """
        model, at = self.problem.model, numpy.array([time])
        ends = [plain_motion(found.flights[number], found.parameters, model, at) for number in (before, after)]
        separation, push = (ends[1][place][0] - ends[0][place][0] for place in (0, 1))
        miss, back = float(numpy.linalg.norm(separation)), -float(separation @ push) / float(numpy.linalg.norm(push))
        lengths = [last - first + 1 for first, last in (self.problem.flights[number] for number in (before, after))]
        spread = 2.0 * self.problem.noise.position * float(numpy.sqrt(numpy.sum(1.0 / numpy.array(lengths))))
        uncertainty = 12.0 * self.problem.noise.position + MISSED * sum(
            gap_deviation(self.problem, each) for each in (before, after)
        )
        return miss if miss > uncertainty or back > CLEAR * spread else 0.0

    def _neighbours(self, first: int, last: int) -> tuple[int | None, int | None]:
        """Numbers of the flights that end and begin at a contact."""
        ends = {flight[1]: number for number, flight in enumerate(self.problem.flights)}
        begins = {flight[0]: number for number, flight in enumerate(self.problem.flights)}
        return ends.get(first), begins.get(last + 1)

    def _with_steps(self, found: ParameterEstimate) -> ParameterEstimate:
        """Add steps of lasting contacts, and of slides with known friction, where impacts and
        flights do not identify all.

        Steps that hide small impacts may contradict any parameters: then all stays as it is.
        """
        wider = with_slides(with_steps(self.problem, self.parts), self.parts)
        if len(wider.contacts) == len(self.problem.contacts):
            return found
        try:
            fit = estimate(wider, found.parameters, self._scale(found))
        except IdentificationError:
            return found
        if not fit.converged:
            return found
        self.problem = wider
        return fit
