"""Draws the exported scenes with Skia's rasterizer on the CPU and prints how its times compare with ours.

Skia draws on one thread, into 32-bit premultiplied pixels: at rate 1 without antialiasing, at rate 16 with its own, which
is by area. Commands are recorded before, as our scene is read before, so that Python is not timed with every shape; the
clock runs from clearing over transforming and drawing to finished pixels. Each picture is compared with ours, so that
both have done the same work.
"""

import json
import statistics
import sys
import time
from pathlib import Path

import numpy
import skia

# Seconds per scene and rate, and fewest frames.
BUDGET, FEWEST = 2.0, 3
# Absolute difference above which the pictures are not of the same scene, as a share of what differs from white in ours, since
# lines leave most of a frame white; and the side of the blocks of pixels whose means are compared. Hairlines choose other
# pixels, and antialiased lines thinner than a pixel are hairlines to Skia, as wide as a pixel and less opaque.
TOLERANCES = {"fills": (0.02, 1), "strokes": (0.1, 1), "fine": (0.2, 8), "hairlines": (0.2, 8)}


class Frames:
    """One scene at one rate, ready to be drawn again and again."""

    def __init__(self, scene, antialias):
        width, height = scene["size"]
        self.surface = skia.Surface.MakeRaster(skia.ImageInfo.MakeN32Premul(width, height))
        recorder = skia.PictureRecorder()
        canvas = recorder.beginRecording(skia.Rect(width, height))
        canvas.scale(width / scene["canvas"][0], height / scene["canvas"][1])
        for shape in scene["shapes"]:
            path = skia.Path.Polygon([skia.Point(x, y) for x, y in shape["points"]], shape["closed"])
            red, green, blue, alpha = shape["color"]
            paint = skia.Paint(AntiAlias=antialias, Color=skia.Color(red, green, blue, alpha))
            if "width" in shape:
                paint.setStyle(skia.Paint.kStroke_Style)
                paint.setStrokeWidth(shape["width"])
                paint.setStrokeCap(skia.Paint.kButt_Cap)
                paint.setStrokeJoin(skia.Paint.kMiter_Join)
                paint.setStrokeMiter(4.0)
            canvas.drawPath(path, paint)
        self.commands = recorder.finishRecordingAsPicture()

    def draw(self):
        """A whole frame; on the CPU it is finished when its last command returns."""
        canvas = self.surface.getCanvas()
        canvas.clear(skia.ColorWHITE)
        canvas.drawPicture(self.commands)

    def times_ms(self):
        """Median and minimum; the first two frames do not count."""
        self.draw()
        self.draw()
        times, start = [], time.perf_counter()
        while len(times) < FEWEST or time.perf_counter() - start < BUDGET:
            before = time.perf_counter()
            self.draw()
            times.append((time.perf_counter() - before) * 1e3)
        return statistics.median(times), min(times)

    def picture(self):
        """Red, green, blue of every pixel."""
        return self.surface.toarray(colorType=skia.kRGBA_8888_ColorType)[:, :, :3]


def main(folder):
    listed = json.loads((folder / "scenes.json").read_text())
    print(f"Skia of skia-python {skia.__version__}; ours on two threads, on one")
    ratios, differs = {}, False
    for scene in listed["scenes"]:
        width, height = scene["size"]
        for rate in dict.fromkeys(ours["rate"] for ours in scene["ours"]):
            frames = Frames(scene, rate > 1)
            median, least = frames.times_ms()
            name = f"{scene['kind']:9} {scene['name']:12} {width:4}x{height:4} rate {rate:2}"
            line = f"{name}: Skia {median:7.3f} ({least:7.3f}) ms"
            tolerance, block = TOLERANCES[scene["kind"]]
            for ours in [ours for ours in scene["ours"] if ours["rate"] == rate]:
                ratio = median / ours["median_ms"], least / ours["min_ms"]
                ratios.setdefault((scene["kind"], rate, ours["threads"]), []).append(ratio)
                line += f", ours {ours['median_ms']:7.3f} ({ours['min_ms']:7.3f}) ms {ratio[0]:5.2f}x ({ratio[1]:5.2f}x)"
                expected = numpy.frombuffer((folder / ours["picture"]).read_bytes(), "u1")
                difference = distance(expected.reshape(height, width, 4)[:, :, :3], frames.picture(), block)
                differs |= difference > tolerance
            print(f"{line}, pictures differ by {difference:.2%}", flush=True)
    report(ratios)
    if differs:
        sys.exit("some pictures are not the same")


def distance(ours, theirs, side):
    """Absolute difference between means of blocks, as a share of what ours has drawn on white."""

    def ink(picture):
        height, width = (length // side for length in picture.shape[:2])
        whole = 255.0 - picture[: height * side, : width * side]
        return whole.reshape(height, side, width, side, 3).mean((1, 3))

    return numpy.abs(ink(ours) - ink(theirs)).sum() / ink(ours).sum()


def report(ratios):
    """The rows of the README."""
    crisp, antialiased = "against Skia without antialiasing", "against Skia with antialiasing"
    asked = {
        ("fills", 1): (f"flat scenes, rate 1, {crisp}", "1x as fast", "1.5x"),
        ("strokes", 1): (f"lines of 3072 and 4000 segments, 1 unit wide, rate 1, {crisp}", "1x as fast", "2x"),
        ("strokes", 16): (f"the same at rate 16, {antialiased}", "1x as fast", "2x"),
        ("fine", 1): (f"the same lines 0.2 units wide, rate 1, {crisp}", "1x as fast", "2x"),
        ("fine", 16): (f"the same at rate 16, {antialiased} (hairlines to Skia)", "1x as fast", "2x"),
        ("hairlines", 1): (f"the same lines as hairlines, one pixel wide, rate 1, {crisp}", "1x as fast", "2x"),
    }
    print("\n| work | must | aim | here | command |\n| --- | --- | --- | --- | --- |")
    for (kind, rate), (work, must, aim) in asked.items():
        (median, least), (alone, _) = (
            [statistics.geometric_mean(column) for column in zip(*ratios[kind, rate, threads])] for threads in (2, 1)
        )
        here = f"{median:.2f}x (minima {least:.2f}x; ours on one thread {alone:.2f}x)"
        print(f"| {work} | {must} | {aim} | {here} | `benches/skia/run` |")


main(Path(sys.argv[1]))
