//! What is read: both dialects, polygons into triangles, the gallery.

mod course;
mod drawings;
mod gallery;
mod svg;
mod triangulation;
