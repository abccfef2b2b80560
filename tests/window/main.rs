//! End to end: the real program in a real window, real keys, real pixels.
