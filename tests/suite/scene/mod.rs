//! What is read: both dialects, polygons into triangles, the gallery.

mod course;
mod drawing_files;
mod drawings;
mod gallery;
mod hostile_drawings;
mod markers;
mod own_triangles;
mod promised;
mod styles;
mod svg;
mod triangulation;
mod viewports;
