//! The buffers of a tile: the base, and above it those of the layers that are open.

/// A stack of buffers that is never empty. Buffers of layers that were closed are kept for those to come.
#[derive(Debug)]
pub(in crate::raster) struct LayerStack<B> {
    buffers: Vec<B>,
    /// How many layers are open above the base.
    open: usize,
}

impl<B> LayerStack<B> {
    /// Nothing but a base.
    pub(in crate::raster) fn new(base: B) -> Self {
        Self {
            buffers: vec![base],
            open: 0,
        }
    }

    /// The lowest buffer, which becomes the picture.
    #[inline]
    pub(in crate::raster) fn base(&self) -> &B {
        &self.buffers[0]
    }

    /// The buffer that is painted on.
    #[inline]
    pub(in crate::raster) fn top(&mut self) -> &mut B {
        &mut self.buffers[self.open]
    }

    /// The buffer that is painted on, and the one below it, if there is one.
    pub(in crate::raster) fn topmost(&self) -> (&B, Option<&B>) {
        let below = self.open.checked_sub(1).map(|below| &self.buffers[below]);
        (&self.buffers[self.open], below)
    }

    /// All buffers in use, the base first.
    pub(in crate::raster) fn in_use(&mut self) -> &mut [B] {
        &mut self.buffers[..=self.open]
    }

    /// Closes all layers, and gives the base to be painted anew.
    pub(in crate::raster) fn restart(&mut self) -> &mut B {
        self.open = 0;
        self.top()
    }

    /// Opens a layer, whose buffer is one that was used before, or made by `new`.
    pub(in crate::raster) fn push(&mut self, new: impl FnOnce() -> B) -> &mut B {
        self.open += 1;
        if self.buffers.len() == self.open {
            self.buffers.push(new());
        }
        self.top()
    }

    /// Closes the topmost layer: the buffer below, and the layer's. `None` where no layer is open.
    pub(in crate::raster) fn pop(&mut self) -> Option<(&mut B, &B)> {
        if self.open == 0 {
            return None;
        }
        let (below, above) = self.buffers.split_at_mut(self.open);
        self.open -= 1;
        below.last_mut().zip(above.first())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_open_and_close_above_the_base() {
        let mut stack = LayerStack::new("base");
        assert_eq!(stack.pop(), None, "the base stays");
        *stack.push(|| "first") = "lower";
        stack.push(|| "upper");
        assert_eq!(stack.topmost(), (&"upper", Some(&"lower")));
        assert_eq!(stack.in_use(), ["base", "lower", "upper"]);
        assert_eq!(stack.pop(), Some((&mut "lower", &"upper")));
        assert_eq!(stack.top(), &mut "lower");
        assert_eq!(stack.push(|| "another"), &mut "upper", "memory is used again");
        assert_eq!(stack.restart(), &mut "base");
        assert_eq!(stack.topmost(), (&"base", None));
    }
}
