"""The set `wall` in Kratos: python3 run.py leaves results.csv, see ../README.md.

x is the tangential direction and z the normal; positive spin is a negative turn about y.
"""

import csv
from pathlib import Path

import KratosMultiphysics as Kratos
from KratosMultiphysics.DEMApplication.DEM_analysis_stage import DEMAnalysisStage

INPUTS = Path("../../wall/results.csv")


class Impact(DEMAnalysisStage):
    """One impact: its motion before, set at the start, and after."""

    def __init__(self, parameters, before):
        super().__init__(Kratos.Model(), parameters)
        self.before = before

    def Initialize(self):
        super().Initialize()
        normal, tangential, spin = self.before
        for node in self.spheres_model_part.Nodes:
            node.SetSolutionStepValue(Kratos.VELOCITY, Kratos.Array3([tangential, 0.0, -normal]))
            node.SetSolutionStepValue(Kratos.ANGULAR_VELOCITY, Kratos.Array3([0.0, -spin, 0.0]))

    def Finalize(self):
        for node in self.spheres_model_part.Nodes:
            velocity = node.GetSolutionStepValue(Kratos.VELOCITY)
            turning = node.GetSolutionStepValue(Kratos.ANGULAR_VELOCITY)
            self.after = velocity[2], velocity[0], -turning[1]
        super().Finalize()


if __name__ == "__main__":
    parameters = Path("ProjectParametersDEM.json").read_text()
    head, *rows = csv.reader(INPUTS.read_text().splitlines())
    with open("results.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(head)
        for row in rows:
            impact = Impact(Kratos.Parameters(parameters), [float(cell) for cell in row[:3]])
            impact.Run()
            writer.writerow([*row[:3], *map(repr, impact.after)])
