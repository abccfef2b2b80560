//! What is said about a pixel.

mod advice;
mod contributions;
mod pixels;
mod seams;
