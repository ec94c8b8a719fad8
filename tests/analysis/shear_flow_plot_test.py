# Lucy: smooth-particle and molecular dynamics on one set of kernels.
# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of sheared fluids on small made-up tables. Exit code 77 (skipped) without numpy and matplotlib."""

import unittest

from green_kubo_plots_test import NAN, PictureTest, csv_text  # and the skipping

import plot_shear_flow

COLUMNS = (*plot_shear_flow.SETTINGS, *plot_shear_flow.WORDS,
           *(name + end for name in plot_shear_flow.MEASURED for end in ("", "_error")), "density_wave")


def row(rate, excess=0.07, error=0.001, fluid="ideal-gas", kernel="lucy", eta=0.5, cooling="isoenergetic", status="ok",
        wave=0.02, particles=1024):
    """A row whose excess is carried by particles."""
    values = dict(particles=particles, strain_rate=rate, range=3, density=1, start_temperature=1,
                  prescribed_viscosity=eta, prescribed_bulk_viscosity=0, prescribed_conductivity=0.5,
                  equation_of_state=fluid, kernel=kernel, cooling=cooling, status=status, viscosity=eta + excess,
                  viscosity_newtonian=0.99 * eta, viscosity_pressure=0.01 * eta, viscosity_carried=excess,
                  viscosity_excess=excess, kinetic_temperature=excess / 4, density_wave=wave)
    return [values.get(column, error) for column in COLUMNS]


class ShearFlowPicture(PictureTest):
    def table(self, *rows):
        self.write("shear_flow.csv", csv_text(COLUMNS, rows))

    def picture(self):
        """What is said on the terminal, and the texts of the picture."""
        return self.draw(plot_shear_flow), self.texts("shear_flow")

    def test_the_fluid_with_most_rates_is_shown_with_its_parts_and_all_with_their_excess(self):
        self.table(row(0.1, eta=2), row(0.02), row(0.05), row(0.1), row(0.05, fluid="van-der-waals"),
                   row(0.05, kernel="monaghan"))
        out, texts = self.picture()
        self.assertEqual(out, "")
        for text in ("Newtonian", "pressure", "carried", "total"):
            self.assertIn(text, texts)
        self.assertTrue(any("Monaghan's weight" in text for text in texts), texts)
        self.assertTrue(any("van der Waals" in text for text in texts), texts)
        self.assertFalse(any("hollow" in text for text in texts), texts)

    def test_bands_are_hollow_and_said_to_be(self):
        self.table(row(0.1), row(0.2, wave=0.4))
        self.assertTrue(any("hollow" in text for text in self.picture()[1]))

    def test_what_cannot_be_shown_is_named(self):
        self.table(row(0.1), row(-0.2, excess=-0.01), row(0.3, excess=NAN, status="failed"),
                   row(0.4, error=NAN, cooling="none", status="short"))
        out, texts = self.picture()
        self.assertIn("rate -0.2: the viscosity is 0.01 below the prescribed one (not shown in the middle)", out)
        self.assertIn("rate 0.3: no viscosity and no kinetic temperature (status failed)", out)
        self.assertIn("rate 0.4: no error bar (white dots, status short)", out)
        self.assertTrue(any("not cooled" in text for text in texts), texts)

    def test_one_row_is_enough(self):
        self.table(row(0.1))
        self.assertEqual(self.picture()[0], "")

    def test_the_same_table_gives_the_same_picture(self):
        self.table(row(0.1), row(0.2))
        self.picture()
        first = [(self.folder / f"shear_flow.{kind}").read_bytes() for kind in ("png", "svg")]
        self.picture()
        self.assertEqual([(self.folder / f"shear_flow.{kind}").read_bytes() for kind in ("png", "svg")], first)

    def test_refusals(self):
        self.refused(plot_shear_flow, "cannot read", "shear_flow.csv")
        self.table(row(0.1, excess=NAN))
        self.refused(plot_shear_flow, "no row with a viscosity")
        self.table(row(0.1))
        self.change("shear_flow.csv", "kinetic_temperature", "noise")
        self.refused(plot_shear_flow, "no column kinetic_temperature")
        self.table(row(0.1))
        self.change("shear_flow.csv", "1024", "many")
        self.refused(plot_shear_flow, 'particles is "many"')


if __name__ == "__main__":
    unittest.main()
