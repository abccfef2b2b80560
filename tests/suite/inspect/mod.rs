//! What is said about a pixel.

mod advice;
mod contributions;
mod painting;
mod pixels;
mod seams;
