"""Draws the exported scenes with llvmpipe, Mesa's OpenGL on the CPU, and prints how its times compare with ours.

Rate 1 is an ordinary frame. Rate 16 is 4x4 supersampling: a target of four times the width and height, averaged by
a second pass. There the screen-space derivatives are a quarter, so `texture` gets a bias of +2: the same mip levels are
read as at rate 1, which is what ours does. The clock runs from clearing to `glFinish`; geometry, texture and pyramid are
uploaded before. Each picture is compared with ours, so that both have done the same work.
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
FLAT = """
#version 330
flat in vec4 mixed;
out vec4 color;
void main() { color = mixed; }
"""
TEXTURED = """
#version 330
uniform sampler2D image;
uniform float bias;
smooth in vec2 mixed;
out vec4 color;
void main() { color = texture(image, mixed, bias); }
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
    ivec2 first = ivec2(gl_FragCoord.xy) * 4;
    color = vec4(0.0);
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 4; x++)
            color += texelFetch(samples, first + ivec2(x, y), 0);
    color /= 16.0;
}
"""
# Seconds per scene and rate, and fewest frames.
BUDGET, FEWEST = 2.0, 3
# Mean absolute difference per channel, in 1/255, above which the pictures are not of the same scene.
TOLERANCE = 1.5
# The same where each weighs the texels of a long footprint in its own way: llvmpipe as ellipses.
ANISOTROPIC_TOLERANCE = 4.0


class Frames:
    """One scene at one rate, ready to be drawn again and again."""

    def __init__(self, context, folder, scene, texture, side):
        width, height = scene["size"]
        self.context, self.texture, self.side = context, texture, side
        textured = scene["kind"] == "textured"
        kind, mix, fragment = ("vec2", "smooth", TEXTURED) if textured else ("vec4", "flat", FLAT)
        program = context.program(VERTEX.replace("ATTRIBUTE", kind).replace("MIX", mix), fragment)
        program["frame"] = (width, height)
        if textured:
            program["bias"] = math.log2(side)
        points = context.buffer((folder / scene["points"]).read_bytes())
        attributes = context.buffer((folder / scene["attributes"]).read_bytes())
        content = [(points, "2f", "point"), (attributes, "2f" if textured else "4f", "given")]
        self.mesh = context.vertex_array(program, content)
        self.blend = scene["translucent"]
        self.final = context.framebuffer([context.texture((width, height), 4)])
        if side > 1:
            self.samples = context.texture((width * side, height * side), 4)
            self.target = context.framebuffer([self.samples])
            corners = numpy.array([-1, -1, 3, -1, -1, 3], "f4")
            self.resolve = context.vertex_array(
                context.program(WHOLE_FRAME, RESOLVE), [(context.buffer(corners), "2f", "point")]
            )
        else:
            self.target = self.final

    def draw(self):
        """A whole frame, finished."""
        context = self.context
        self.target.use()
        self.target.clear(1.0, 1.0, 1.0, 1.0)
        if self.blend:
            context.enable(moderngl.BLEND)
            context.blend_func = moderngl.ONE, moderngl.ONE_MINUS_SRC_ALPHA
        self.texture.use()
        self.mesh.render()
        context.disable(moderngl.BLEND)
        if self.side > 1:
            self.final.use()
            self.samples.use()
            self.resolve.render()
        context.finish()

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
    texture.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR
    ratios, differs = {}, False
    for scene in listed["scenes"]:
        for ours in scene["ours"]:
            texture.anisotropy = ours["anisotropy"]
            frames = Frames(context, folder, scene, texture, math.isqrt(ours["rate"]))
            median, least = frames.times_ms()
            expected = numpy.frombuffer((folder / ours["picture"]).read_bytes(), "u1")
            difference = numpy.abs(frames.picture().astype("i2") - expected).mean()
            differs |= difference > (TOLERANCE if ours["anisotropy"] == 1 else ANISOTROPIC_TOLERANCE)
            ratio = median / ours["median_ms"], least / ours["min_ms"]
            ratios.setdefault((scene["kind"], ours["rate"], ours["anisotropy"]), []).append(ratio)
            width, height = scene["size"]
            print(
                f"{scene['kind']:8} {scene['name']:13} {width:4}x{height:4} rate {ours['rate']:2}"
                f" anisotropy {ours['anisotropy']:2}: llvmpipe"
                f" {median:8.3f} ({least:8.3f}) ms, ours {ours['median_ms']:8.3f} ({ours['min_ms']:8.3f}) ms,"
                f" {ratio[0]:6.2f}x ({ratio[1]:6.2f}x), pictures differ by {difference:.2f}/255",
                flush=True,
            )
    report(ratios)
    if differs:
        sys.exit("some pictures are not the same")


def report(ratios):
    """The rows of the README."""
    asked = {
        ("flat", 16, 1): ("flat scenes, rate 16, against llvmpipe at 4x4 supersampling", "30x as fast", ""),
        ("textured", 1, 1): ("textured meshes, trilinear, rate 1, against llvmpipe", "1x as fast", "2x"),
        ("textured", 16, 1): ("the same at rate 16, against llvmpipe at 4x4 supersampling", "2x as fast", "4x"),
        ("textured", 1, 16): ("the same at rate 1, anisotropy 16 in both", "1x as fast", "2x"),
    }
    print("\n| work | must | aim | here | command |\n| --- | --- | --- | --- | --- |")
    for key, (work, must, aim) in asked.items():
        median, least = (statistics.geometric_mean(column) for column in zip(*ratios[key]))
        print(f"| {work} | {must} | {aim} | {median:.2f}x (minima {least:.2f}x) | `benches/llvmpipe/run` |")


main(Path(sys.argv[1]))
