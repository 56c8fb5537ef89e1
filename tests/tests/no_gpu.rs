//! Tests that need no graphics driver.

mod no_gpu {
    mod compare;
    mod device;
    mod limits;
    mod minray;
    mod pages;
    mod paths;
    mod promises;
    mod reference;
    mod traversal;
}
