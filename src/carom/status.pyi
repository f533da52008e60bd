from .collisions.records import CollisionStatus as CollisionStatus, Judgement as Judgement
from .dem.base import LawStatus as LawStatus
from .dimensionless.elastic.phases import Status as Status
from .sweeps.points import PointStatus as PointStatus
