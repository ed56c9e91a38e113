"""The address of the laboratory: what stands after the # of a link is the recipe of a run.

    lab.html#system=double&form=rods&m1=1&…&state=2.0943951023931953,0,0,0&t_max=10&method=rk4&step=0.001

* Entries key=value are joined by &; each key stands once. Reserved characters are percent-encoded;
  a + is a plus sign, not a space.
* Keys are named as Python's arguments are: those of `address.json`, the parameters of the system's
  form, and the options of a run (step, tolerance, max_steps, certify, digits) of the catalogue.
* A number is decimal, with a point, in SI units and radians, finite. The shortest decimal form that
  gives the double back is written, so that a link carries every bit: -0 keeps its sign.
* A list has commas: the state is the components in the catalogue's order.
* What is left out is standard. A writer names every parameter but those that are zero as standard.
* Nothing is clamped or ignored: an unknown key, a name that is none, a value out of range and an
  option that the method does not take are refused.
* The keys of the page (`address.json`, "page") choose what is shown; they do not change a run.

The page reads and writes the same: `tests/data/addresses.json` has the cases of both.
"""
