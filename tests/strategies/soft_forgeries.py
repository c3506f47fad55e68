"""What a grasp file says of torsional friction, altered on purpose, and who notices: see `forgeries`."""

from tests.strategies.forgeries import (
    NOBODY,
    OBJECT,
    PROOF,
    READING,
    Document,
    Forgery,
    both,
    drop,
    others,
    put,
    times,
)

LISTED = "certificate/candidates/torsion"

PATCH, TORSION = "candidate_choice/patch", "candidate_choice/torsion"


def weaken(document: Document) -> None:
    """The candidates that were not chosen twist less."""
    for index in others(document):
        document["certificate"]["candidates"]["torsion"][index] *= 0.1


def harden(document: Document) -> None:
    """They do not twist at all."""
    for index in others(document):
        document["certificate"]["candidates"]["torsion"][index] = 0.0


def strengthen(document: Document) -> None:
    """The contacts twist more, their candidates with them."""
    for contact in document["contacts"]:
        contact["torsion"] *= 1.5
        document["certificate"]["candidates"]["torsion"][contact["candidate"]] *= 1.5


def twist_where_nothing_twists(document: Document) -> None:
    """No torsional friction anywhere, and the torques stay."""
    document["certificate"]["candidates"].pop("torsion")
    for contact in document["contacts"]:
        contact.pop("torsion")


def twist_more(document: Document) -> None:
    """Torques and torsional friction, all of them."""
    strengthen(document)
    document["torques"] = times(1.5)(document["torques"])


SOFT_FORGERIES = (
    Forgery(name="contact: torsion raised", alter=put("contacts/0/torsion", times(2)), noticed=READING),
    Forgery(name="contact: torsion lowered", alter=put("contacts/1/torsion", times(0.5)), noticed=READING),
    Forgery(name="contact: torsion negative", alter=put("contacts/0/torsion", -0.002), noticed=READING),
    Forgery(name="contact: torsion forgotten", alter=put("contacts/0/torsion", None), noticed=READING),
    Forgery(name="contacts: torsion raised, their candidates' too", alter=strengthen, noticed=OBJECT),
    Forgery(name="contacts: torsion and torques raised", alter=twist_more, noticed=OBJECT),
    Forgery(name="candidates: others twist less", alter=weaken, noticed=OBJECT),
    Forgery(name="candidates: others are hard", alter=harden, noticed=OBJECT),
    Forgery(name="candidates: one twists less", alter=put(f"{LISTED}/0", times(0.9)), noticed=OBJECT),
    Forgery(
        name="candidates: a torsion that is no length",
        alter=put(f"{LISTED}/0", -1.0),
        noticed=READING,
    ),
    Forgery(
        name="candidates: torsion of one lost",
        alter=put(LISTED, lambda rows: rows[1:]),
        noticed=READING,
    ),
    Forgery(name="torsion forgotten everywhere", alter=twist_where_nothing_twists, noticed=READING),
    Forgery(name="torques: one turned round", alter=put("torques/0/0", times(-1)), noticed=PROOF),
    Forgery(name="torques: halved", alter=put("torques", times(0.5)), noticed=PROOF),
    Forgery(name="torques: none", alter=put("torques", None), noticed=PROOF),
    Forgery(name="torques: of a wrench lost", alter=put("torques", lambda rows: rows[1:]), noticed=READING),
    Forgery(name="choice: a larger patch", alter=put(PATCH, times(2)), noticed=OBJECT),
    Forgery(name="choice: no patch", alter=drop(PATCH), noticed=OBJECT),
    Forgery(name="choice: torsion and a patch", alter=put(TORSION, 0.002), noticed=OBJECT),
    Forgery(
        name="choice: torsion in place of the patch",
        alter=both(drop(PATCH), put(TORSION, 0.1)),
        noticed=OBJECT,
    ),
    Forgery(name="choice: a patch that is no length", alter=put(PATCH, -1.0), noticed=OBJECT),
    Forgery(
        name="an older version than torsion",
        alter=put("format_version", 2),
        noticed=NOBODY,
        why="what it says is checked all the same",
    ),
)
