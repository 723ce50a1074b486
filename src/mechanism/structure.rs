//! Mobility and decomposition into the driver and Assur groups.
