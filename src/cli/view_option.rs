//! `--view default|canvas|CX,CY,SCALE[,ROTATION]`.

use glam::DVec2;

use crate::geometry::View;

/// Reads a view: its name, or centre, pixels per canvas unit and rotation in degrees.
pub(super) fn parse(text: &str) -> Result<View, String> {
    match text {
        "default" => return Ok(View::Default),
        "canvas" => return Ok(View::Canvas),
        _ => {}
    }
    let problem = || {
        "a view is default, canvas, or CX,CY,SCALE[,ROTATION]: centre in canvas units, pixels per unit above zero, degrees"
            .to_owned()
    };
    let numbers: Option<Vec<f64>> = text
        .split(',')
        .map(|number| number.trim().parse().ok().filter(|number: &f64| number.is_finite()))
        .collect();
    match numbers.as_deref() {
        Some([x, y, scale, rest @ ..]) if *scale > 0.0 && rest.len() < 2 => Ok(View::At {
            center: DVec2::new(*x, *y),
            scale: *scale,
            rotation: rest.first().copied().unwrap_or(0.0),
        }),
        _ => Err(problem()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn view_reads_names_and_numbers() {
        assert_eq!(parse("default"), Ok(View::Default), "by name");
        assert_eq!(parse("canvas"), Ok(View::Canvas), "by name");
        let at = |rotation| View::At {
            center: DVec2::new(10.0, -2.5),
            scale: 0.5,
            rotation,
        };
        assert_eq!(parse("10,-2.5,0.5"), Ok(at(0.0)), "three numbers");
        assert_eq!(parse("10, -2.5, 0.5, 90"), Ok(at(90.0)), "four numbers, blanks");
        for text in [
            "",
            "fit",
            "1,2",
            "1,2,0",
            "1,2,-3",
            "1,2,nan",
            "1,inf,3",
            "1,2,3,4,5",
            "1,2,3,",
            "1,,2,3",
        ] {
            assert!(parse(text).is_err(), "{text:?} is no view");
        }
    }
}
