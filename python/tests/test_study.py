"""Studies, landings, tables, campaigns, rigs; with whatever of numpy, pandas and h5py is there."""

import math
import os
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings
import warnings
from pathlib import Path

import bolter
from bolter.table import numpy

PROGRAM = os.environ.get("BOLTER", str(Path(__file__).resolve().parents[2] / "build/bolter"))

try:
    import pandas
except ImportError:
    pandas = None
try:
    import h5py
except ImportError:
    h5py = None

COARSE = [f"deck.cable.mesh.{part}_length=0.6 m" for part in ("fine", "medium", "coarse")]


def quick() -> bolter.Study:
    """The reference with a coarse cable: landings of a few milliseconds."""
    return bolter.Study.example("reference", COARSE)


class Keys(unittest.TestCase):
    def test_texts_carry_units_and_numbers_are_si(self):
        with bolter.Study.example() as study:
            study["landing.pitch"] = "4 deg"
            self.assertAlmostEqual(study["landing.pitch"], math.radians(4), delta=1e-15)
            study["landing.pitch"] = 0.05
            self.assertEqual(study["landing.pitch"], 0.05)
            study.set("campaign.samples", 32)
            study["uncertainty.landing.pitch"] = {
                "distribution": "normal",
                "mean": "3 deg",
                "sd": "1 deg",
            }
            self.assertIn("samples: 32", study.text)
            self.assertIn("distribution: normal", study.text)

    def test_mistakes_have_place_and_change_nothing(self):
        with bolter.Study.defaults() as study:
            before = study["landing.pitch"]
            for value, kind in ((9.0, bolter.ArgumentError), ("4 kg", bolter.InputError)):
                with self.assertRaises(kind) as raised:
                    study["landing.pitch"] = value
                self.assertIn("landing.pitch", str(raised.exception))
            with self.assertRaises(bolter.InputError):
                study["landing.pich"] = "4 deg"
            with self.assertRaises(bolter.ArgumentError):
                study["landing.pich"]
            self.assertEqual(study["landing.pitch"], before)
        text = "title: x\nlanding:\n  pitch: 3 kg\n"
        with self.assertRaises(bolter.InputError) as raised:
            bolter.Study.from_text(text, "mine.yaml")
        places = [(m.file, m.line, m.column) for m in raised.exception.messages]
        self.assertIn(("mine.yaml", 3, 10), places)
        self.assertIsInstance(raised.exception, ValueError)

    def test_a_file_that_is_not_there(self):
        with self.assertRaises(bolter.FileError) as raised:
            bolter.Study.open("no/such/study.yaml")
        self.assertIn("no/such/study.yaml", str(raised.exception))
        self.assertIsInstance(raised.exception, OSError)

    def test_every_key_has_range_and_meaning(self):
        keys = {key.path: key for key in bolter.keys()}
        sink = keys["landing.sink_speed"]
        self.assertEqual((sink.unit, sink.kind), ("m/s", "number"))
        self.assertTrue(sink.least <= sink.default <= sink.greatest and sink.text)

    def test_a_closed_study_says_so(self):
        study = bolter.Study.defaults()
        study.close()
        study.close()
        with self.assertRaises(bolter.ArgumentError):
            study.land()
        with self.assertRaises(bolter.ArgumentError):
            study.text

    def test_messages_are_read_apart(self):
        parse = bolter.Message.parse
        self.assertEqual(parse("a:b.yaml:3:7: error: x: y"), ("error", "a:b.yaml", 3, 7, "x: y"))
        self.assertEqual(parse("s.yaml: warning: x"), ("warning", "s.yaml", None, None, "x"))
        self.assertEqual(parse("note: x"), ("note", None, None, None, "x"))
        for text in ("a.yaml:3:7: error: x", "s.yaml: note: y", "error: z"):
            self.assertEqual(str(parse(text)), text)


class Landings(unittest.TestCase):
    def test_histories_hold_the_peaks_and_change_no_bit(self):
        with quick() as study:
            plain, seen = study.land(), study.land(histories=True)
        self.assertEqual(plain.state_hash, seen.state_hash)
        self.assertIsNone(plain.histories)
        self.assertEqual(seen.histories.rows, seen.steps + 1)
        self.assertAlmostEqual(
            max(seen.histories["left_stroke_m"]), seen.strut_stroke_max_left_m, delta=1e-12
        )
        self.assertEqual(seen.histories.unit("nose_wheel_spin_radps"), "rad/s")
        self.assertEqual(len(seen.cable.time_s), len(seen.cable.x_m))
        self.assertEqual(len(seen.cable.x_m[0]), len(seen.cable.tension_N[0]) + 1)
        self.assertAlmostEqual(seen.cable.tension_N[0][0], 24e3, delta=30)
        self.assertEqual(seen.cable.time_s[-1], seen.histories["time_s"][-1])

    def test_units_and_names_are_those_of_the_results(self):
        with quick() as study:
            landing = study.land()
        self.assertEqual(landing.unit("margin_m"), "m")
        self.assertEqual(landing["margin_m"], landing.margin_m)
        self.assertIn(landing.outcome, ("engaged", "missed"))
        self.assertEqual(bolter.modes()[int(landing["mode"])], landing.__dict__["mode"])
        with self.assertRaises(AttributeError):
            landing.no_such_result

    def test_a_table_is_the_landings_one_by_one(self):
        distances = [2.0, 4.0, 9.0]
        columns = ["outcome", "mode", "margin_m"]
        with quick() as study:
            points = {"landing.distance": distances, "landing.pitch": 0.06}
            one = study.map(points, columns, threads=1)
            rows = [[d, 0.06] for d in distances]
            two = study.map(rows, columns, paths=["landing.distance", "landing.pitch"], threads=2)
            single = []
            study["landing.pitch"] = 0.06
            for distance in distances:
                study["landing.distance"] = distance
                single.append(study.land())
        for name in columns:
            self.assertEqual(list(map(repr, one[name])), list(map(repr, two[name])))
            self.assertEqual(list(map(repr, one[name])), [repr(l[name]) for l in single])
        self.assertEqual(one.unit("margin_m"), "m")

    def test_a_point_that_cannot_be_landed_is_a_failed_one(self):
        with quick() as study:
            table = study.map({"aircraft.mass": [10.0, study["aircraft.mass"]]})
        self.assertTrue(math.isnan(table["outcome"][0]))
        self.assertFalse(math.isnan(table["outcome"][1]))

    def test_no_points_are_no_rows(self):
        with quick() as study:
            self.assertEqual(study.map([], paths=["landing.pitch"]).rows, 0)

    def test_unknown_names_and_shapes_are_refused(self):
        with quick() as study:
            with self.assertRaises(bolter.ArgumentError):
                study.map({"landing.pich": [0.05]})
            with self.assertRaises(bolter.ArgumentError):
                study.map({"landing.pitch": [0.05]}, ["no_such_m"])
            with self.assertRaises(bolter.ArgumentError):
                study.map([[0.05, 1.0]], paths=["landing.pitch"])
            with self.assertRaises(bolter.ArgumentError):
                study.map({"landing.pitch": [0.05], "landing.distance": [1.0, 2.0]})
            with self.assertRaises(bolter.ArgumentError):
                study.map([[0.05]])

    def test_progress_stops_and_its_exceptions_come_through(self):
        def stop(done, count):
            return False

        def fail(done, count):
            raise KeyError("mine")

        points = {"landing.distance": [4 + 0.01 * i for i in range(400)]}
        with quick() as study:
            with self.assertRaises(bolter.InterruptedRunError):
                study.map(points, progress=stop)
            with self.assertRaises(KeyError):
                study.map(points, progress=fail)
            self.assertFalse(study.land().failed)

    def test_one_call_at_a_time(self):
        errors = []

        def call_again(done, count):
            try:
                study.land()
            except bolter.ArgumentError as error:
                errors.append(error)
            return False

        with quick() as study, self.assertRaises(bolter.InterruptedRunError):
            study.map({"landing.distance": [4 + 0.01 * i for i in range(400)]}, progress=call_again)
        self.assertTrue(errors)

    def test_studies_land_in_threads_of_their_own(self):
        hashes = []

        def land():
            with quick() as study:
                hashes.append(study.land().state_hash)

        threads = [threading.Thread(target=land) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(hashes), 4)
        self.assertEqual(len(set(hashes)), 1)

    def test_a_flight_is_the_landing_step_by_step(self):
        with quick() as study:
            landing = study.land(histories=True)
            flight = study.flight()
        steps, twin = 0, None
        while flight.step():
            steps += 1
            if steps == 100:
                twin = flight.copy()
                self.assertTrue(twin.equals(flight))
        self.assertEqual(flight.report()["state_hash"], landing.state_hash)
        self.assertEqual(flight.look()["time_s"], landing.histories["time_s"][-1])
        self.assertFalse(twin.equals(flight))
        while twin.step():
            pass
        self.assertEqual(twin.report(), flight.report())

    @unittest.skipUnless(pandas, "no pandas")
    def test_data_frames_go_in_and_out(self):
        frame = pandas.DataFrame({"landing.distance": [4.0, 6.0]})
        with quick() as study:
            table = study.map(frame).frame()
        self.assertEqual(list(table.columns), ["outcome", "margin_m"])
        self.assertEqual(len(table), 2)

    @unittest.skipUnless(numpy is not None, "no numpy")
    def test_columns_are_arrays(self):
        with quick() as study:
            table = study.map(numpy.array([[4.0], [6.0]]), paths=["landing.distance"])
        self.assertEqual(table["margin_m"].shape, (2,))
        self.assertEqual(table["margin_m"].dtype, float)


class Campaigns(unittest.TestCase):
    def test_campaign_ledger_classifier(self):
        seen = []
        with tempfile.TemporaryDirectory() as folder, quick() as study:
            study.directory = Path(folder, "campaign")
            study["campaign.samples"] = 64
            with self.assertRaises(bolter.FileError):
                study.ledger()
            counts = study.campaign(progress=seen.append)
            self.assertEqual((counts.total, counts.done, counts.failed), (64, 64, 0))
            self.assertEqual(seen[-1].done, 64)
            ledger = study.ledger()
            self.assertEqual(list(ledger["run"]), list(range(64)))
            self.assertEqual(list(ledger["outcome"]).count("engaged"), counts.engaged)
            self.assertEqual(ledger.unit("landing.pitch"), "rad")
            with self.assertRaises(bolter.ArgumentError):
                study.predict([[1, 2, 3, 4]])
            fit = study.fit()
            self.assertEqual(fit.train_count + fit.holdout_count, 64)
            self.assertEqual(sum(map(sum, fit.confusion)), fit.holdout_count)
            self.assertFalse(study.fit().trained_now)
            values = study.predict({path: ledger[path] for path in fit.inputs})
            right = sum((v > 0) == (o == "engaged") for v, o in zip(values, ledger["outcome"]))
            self.assertEqual(right, fit.train_correct + fit.holdout_correct)

    def test_reliability_has_a_row_per_condition_and_one_for_the_study(self):
        sets = ["campaign.samples=256", "reliability.samples=20000", "reliability.high_fidelity_runs=8"]
        conditions = "reliability.conditions={landing.distance: [4 m, 6 m]}"
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore", bolter.BolterWarning)
            study = bolter.Study.example("reference", [*COARSE, *sets, conditions])
            study.directory = Path(folder, "campaign")
            with self.assertRaises(bolter.FileError):
                study.reliability()
            study.campaign()
            seen = []
            table = study.reliability(progress=lambda done, total: seen.append((done, total)))
        self.assertEqual(list(table["parameter"]), ["landing.distance"] * 2 + [""])
        self.assertEqual(list(table["value"][:2]), [4, 6])
        self.assertTrue(seen)
        for low, p, high in zip(
            table["corrected_low"], table["corrected"], table["corrected_high"]
        ):
            self.assertTrue(0 <= low <= p <= high <= 1)

    def test_shards_share_the_design(self):
        with tempfile.TemporaryDirectory() as folder, quick() as study:
            study.directory = Path(folder, "campaign")
            study["campaign.samples"] = 8
            self.assertEqual(study.campaign(shard=1, shards=2).total, 4)
            self.assertEqual(list(study.ledger()["run"]), [1, 3, 5, 7])


class Rigs(unittest.TestCase):
    def test_a_drop_meets_its_reference(self):
        with bolter.Study.example() as study:
            rig = study.rig("nose_drop")
            again = study.rig("nose_drop", histories=False)
        stroke = rig.metrics["stroke_max_m"]
        self.assertTrue(stroke.accepted and abs(stroke.error_percent) < 1)
        self.assertEqual(rig["stroke_max_m"], again["stroke_max_m"])
        self.assertEqual(again.histories.rows, 0)
        self.assertAlmostEqual(max(rig.histories["stroke_m"]), stroke.value, delta=1e-5)
        times = list(rig.histories["time_s"])
        self.assertTrue(all(a < b for a, b in zip(times, times[1:])))

    def test_a_rig_that_is_not_there(self):
        with bolter.Study.example() as study:
            with self.assertRaises(bolter.ArgumentError):
                study.rig("tail_drop")


class Histories(unittest.TestCase):
    def written(self, name: str) -> bolter.Table:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, name)
            study = bolter.find_study("reference")
            sets = [word for text in COARSE for word in ("--set", text)]
            subprocess.run([PROGRAM, "land", str(study), *sets, "-q", "-o", str(path)], check=True)
            return bolter.read_history(path)

    def test_csv_files_are_the_histories_of_land(self):
        table = self.written("landing.csv")
        with quick() as study:
            histories = study.land(histories=True).histories
        self.assertEqual(table.names, histories.names)
        for name in table:
            self.assertEqual(list(table[name]), list(histories[name]))

    @unittest.skipUnless(h5py, "no h5py")
    def test_hdf5_files_have_units_and_shapes(self):
        table = self.written("landing.h5")
        self.assertEqual(table["legs/stroke_m"].shape, (len(table["time_s"]), 3))
        self.assertEqual(table.unit("hook/angle_rad"), "rad")
        self.assertEqual(table["cable/x_m"].shape[1], table["cable/tension_N"].shape[1] + 1)

    def test_a_file_that_is_not_there(self):
        with self.assertRaises(bolter.FileError):
            bolter.read_history("no/such.csv")


class WithoutNumpy(unittest.TestCase):
    @unittest.skipUnless(numpy is not None, "numpy is not there in the first place")
    def test_lists_do_the_same(self):
        script = (
            "import sys; sys.modules['numpy'] = None\n"
            "import bolter\n"
            f"study = bolter.Study.example('reference', {COARSE!r})\n"
            "table = study.map({'landing.distance': [4.0, 6.0]})\n"
            "assert isinstance(table['margin_m'], list)\n"
            "print([v.hex() for v in table['margin_m']])\n"
        )
        run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)
        with quick() as study:
            table = study.map({"landing.distance": [4.0, 6.0]})
        self.assertEqual(run.stdout.strip(), str([v.hex() for v in table["margin_m"]]))


if __name__ == "__main__":
    unittest.main()
