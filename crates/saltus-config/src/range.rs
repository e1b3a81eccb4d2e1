//! Ranges of fields of the study file that garde has no word for.

/// Refuses NaN and infinity: comparisons with NaN are false, so a range lets it pass.
pub(crate) fn finite(value: &f64, _: &()) -> garde::Result {
    if value.is_finite() {
        Ok(())
    } else {
        Err(garde::Error::new("a finite number is needed"))
    }
}

pub(crate) fn finite_if_given(value: &Option<f64>, context: &()) -> garde::Result {
    value.as_ref().map_or(Ok(()), |v| finite(v, context))
}

pub(crate) fn poisson(value: &f64, _: &()) -> garde::Result {
    let possible = *value > -1.0 && *value < 0.5;
    if possible {
        Ok(())
    } else {
        Err(garde::Error::new("a number between -1 and 0.5 is needed"))
    }
}
