from .dimensionless.elastic.phases import Status as Status
from .dimensionless.law import LawStatus as LawStatus
from .many.collisions.records import CollisionStatus as CollisionStatus, Judgement as Judgement
from .many.sweeps.points import PointStatus as PointStatus
