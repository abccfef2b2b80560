//! What is read: both dialects, polygons into triangles, the gallery.

mod course;
mod drawings;
mod gallery;
mod hostile_drawings;
mod svg;
mod triangulation;
