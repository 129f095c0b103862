var r=class extends Error{name="InputError"};export{r as InputError};
