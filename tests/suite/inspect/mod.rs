//! What is said about a pixel.

mod advice;
mod asked_rendering;
mod contributions;
mod painting;
mod pixels;
mod reasons;
mod seams;
mod siblings;
mod textures;
