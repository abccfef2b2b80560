"""Draws the exported scenes with llvmpipe, Mesa's OpenGL on the CPU, and prints how its times compare with ours.

Rate 1 is an ordinary frame. Rate 16 is 4x4 supersampling: a target of four times the width and height, averaged by
a second pass. There the screen-space derivatives are a quarter, so `texture` gets a bias of +2: the same mip levels are
read as at rate 1, which is what ours does. The clock runs from clearing to `glFinish`; geometry, texture and pyramid are
uploaded before. Where a way of drawing is listed as not downsampled, the second pass is outside of the time: llvmpipe's is of
samples, ours of finished pixels all the same. Each picture is compared with ours, so that both have done the same work.
"""

import json
import math
import statistics
import sys
import time
from pathlib import Path

import moderngl
import numpy

VERTEX = """
#version 330
uniform vec2 frame;
in vec2 point;
in ATTRIBUTE given;
MIX out ATTRIBUTE mixed;
void main() {
    mixed = given;
    gl_Position = vec4(point / frame * 2.0 - 1.0, 0.0, 1.0);
}
"""
COLORED = """
#version 330
MIX in vec4 mixed;
out vec4 color;
void main() { color = mixed; }
"""
TRILINEAR = """
#version 330
uniform sampler2D image;
uniform float bias;
smooth in vec2 mixed;
out vec4 color;
void main() { color = texture(image, mixed, bias); }
"""
LEVEL_ZERO = """
#version 330
uniform sampler2D image;
smooth in vec2 mixed;
out vec4 color;
void main() { color = texture(image, mixed); }
"""
WHOLE_FRAME = """
#version 330
in vec2 point;
void main() { gl_Position = vec4(point, 0.0, 1.0); }
"""
RESOLVE = """
#version 330
uniform sampler2D samples;
out vec4 color;
void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * SIDE;
    color = vec4(0.0);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++)
            color += texelFetch(samples, first + ivec2(x, y), 0);
    color /= float(SIDE * SIDE);
}
"""
FILTERS = {
    "trilinear": (moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR),
    "bilinear": (moderngl.LINEAR, moderngl.LINEAR),
    "nearest": (moderngl.NEAREST, moderngl.NEAREST),
}
# Seconds per scene and rate, and fewest frames.
BUDGET, FEWEST = 2.0, 3
# Mean absolute difference per channel, in 1/255, above which the pictures are not of the same scene.
TOLERANCE = 1.5
# The same where each weighs the texels of a long footprint in its own way: llvmpipe as ellipses.
ANISOTROPIC_TOLERANCE = 4.0


class Frames:
    """One scene drawn in one way, ready to be drawn again and again."""

    def __init__(self, context, folder, scene, texture, ours):
        width, height = scene["size"]
        self.context, self.texture, self.side = context, texture, math.isqrt(ours["rate"])
        self.downsampled = ours["downsampled"]
        textured = scene["kind"] == "textured"
        biased = textured and ours["filter"] == "trilinear"
        mix = "flat" if scene["kind"] == "flat" else "smooth"
        fragment = (TRILINEAR if biased else LEVEL_ZERO) if textured else COLORED
        vertex = VERTEX.replace("ATTRIBUTE", "vec2" if textured else "vec4")
        program = context.program(vertex.replace("MIX", mix), fragment.replace("MIX", mix))
        program["frame"] = (width, height)
        if biased:
            program["bias"] = math.log2(self.side)
        points = context.buffer((folder / scene["points"]).read_bytes())
        attributes = context.buffer((folder / scene["attributes"]).read_bytes())
        content = [(points, "2f", "point"), (attributes, "2f" if textured else "4f", "given")]
        self.mesh = context.vertex_array(program, content)
        self.blend = scene["translucent"]
        self.final = context.framebuffer([context.texture((width, height), 4)])
        if self.side > 1:
            self.samples = context.texture((width * self.side, height * self.side), 4)
            self.target = context.framebuffer([self.samples])
            corners = numpy.array([-1, -1, 3, -1, -1, 3], "f4")
            resolve = context.program(WHOLE_FRAME, RESOLVE.replace("SIDE", str(self.side)))
            self.mean = context.vertex_array(resolve, [(context.buffer(corners), "2f", "point")])
        else:
            self.target = self.final

    def draw(self):
        """A whole frame, finished; where it is not downsampled, its samples."""
        context = self.context
        self.target.use()
        self.target.clear(1.0, 1.0, 1.0, 1.0)
        if self.blend:
            context.enable(moderngl.BLEND)
            context.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self.texture.use()
        self.mesh.render()
        context.disable(moderngl.BLEND)
        if self.downsampled:
            self.downsample()
        context.finish()

    def downsample(self):
        """The mean of each pixel's samples."""
        if self.side > 1:
            self.final.use()
            self.samples.use()
            self.mean.render()

    def times_ms(self):
        """Median and minimum; the first two frames, which compile shaders, do not count."""
        self.draw()
        self.draw()
        times, start = [], time.perf_counter()
        while len(times) < FEWEST or time.perf_counter() - start < BUDGET:
            before = time.perf_counter()
            self.draw()
            times.append((time.perf_counter() - before) * 1e3)
        return statistics.median(times), min(times)

    def picture(self):
        """Rows from the top: the vertex shader puts the first row where OpenGL has its own first row."""
        if not self.downsampled:
            self.downsample()
        return numpy.frombuffer(self.final.read(components=4), "u1")


def main(folder):
    listed = json.loads((folder / "scenes.json").read_text())
    context = moderngl.create_context(standalone=True, backend="egl")
    if "llvmpipe" not in context.info["GL_RENDERER"]:
        sys.exit(f"this is {context.info['GL_RENDERER']}, not llvmpipe")
    print(context.info["GL_RENDERER"], context.info["GL_VERSION"], sep=", ")
    side = listed["texture"]["side"]
    texture = context.texture((side, side), 4, (folder / listed["texture"]["file"]).read_bytes())
    texture.repeat_x = texture.repeat_y = False
    texture.build_mipmaps()
    ratios, differs = {}, False
    for scene in listed["scenes"]:
        for ours in scene["ours"]:
            texture.filter, texture.anisotropy = FILTERS[ours["filter"]], ours["anisotropy"]
            frames = Frames(context, folder, scene, texture, ours)
            median, least = frames.times_ms()
            expected = numpy.frombuffer((folder / ours["picture"]).read_bytes(), "u1")
            difference = numpy.abs(frames.picture().astype("i2") - expected).mean()
            differs |= difference > (TOLERANCE if ours["anisotropy"] == 1 else ANISOTROPIC_TOLERANCE)
            ratio = median / ours["median_ms"], least / ours["min_ms"]
            filtered = ours["filter"] if scene["kind"] == "textured" else ""
            ratios.setdefault((scene["kind"], filtered, ours["rate"], ours["anisotropy"]), []).append(ratio)
            width, height = scene["size"]
            print(
                f"{scene['kind']:8} {scene['name']:13} {width:4}x{height:4} rate {ours['rate']:2}"
                f" {filtered:9} anisotropy {ours['anisotropy']:2}: llvmpipe"
                f" {median:8.3f} ({least:8.3f}) ms, ours {ours['median_ms']:8.3f} ({ours['min_ms']:8.3f}) ms,"
                f" {ratio[0]:6.2f}x ({ratio[1]:6.2f}x), pictures differ by {difference:.2f}/255",
                flush=True,
            )
    report(ratios)
    if differs:
        sys.exit("some pictures are not the same")


def report(ratios):
    """The rows of the README."""
    flat, textured, colored = "flat scenes", "textured meshes", "colours at corners"
    by_two, by_four = (f"against llvmpipe at {side} without downsampling" for side in ("2x2", "4x4"))
    asked = {
        ("flat", "", 16, 1): (f"{flat}, rate 16, against llvmpipe at 4x4 supersampling", "30x as fast", ""),
        ("textured", "trilinear", 1, 1): (f"{textured}, trilinear, rate 1, against llvmpipe", "1x as fast", "2x"),
        ("textured", "trilinear", 16, 1): (
            "the same at rate 16, against llvmpipe at 4x4 supersampling", "2x as fast", "4x"
        ),
        ("textured", "trilinear", 1, 16): ("the same at rate 1, anisotropy 16 in both", "1x as fast", "2x"),
        ("textured", "nearest", 4, 1): (f"{textured}, nearest, level zero, rate 4, {by_two}", "1.3x as fast", "2x"),
        ("textured", "bilinear", 4, 1): (f"{textured}, bilinear, level zero, rate 4, {by_two}", "1.3x as fast", "2x"),
        ("textured", "nearest", 16, 1): (f"{textured}, nearest, level zero, rate 16, {by_four}", "2.5x as fast", "4x"),
        ("textured", "bilinear", 16, 1): (
            f"{textured}, bilinear, level zero, rate 16, {by_four}", "2.5x as fast", "4x"
        ),
        ("colored", "", 1, 1): (f"{colored}, rate 1, against llvmpipe", "1.2x as fast", "2x"),
        ("colored", "", 4, 1): (f"{colored}, rate 4, {by_two}", "1.2x as fast", "2x"),
    }
    print("\n| work | must | aim | here | command |\n| --- | --- | --- | --- | --- |")
    for key, (work, must, aim) in asked.items():
        median, least = (statistics.geometric_mean(column) for column in zip(*ratios[key]))
        print(f"| {work} | {must} | {aim} | {median:.2f}x (minima {least:.2f}x) | `benches/llvmpipe/run` |")


main(Path(sys.argv[1]))
