"""What of each publication is in the program, and its misprints; keys are those of sources.py."""

from simc_core.wording import Text, said

USES = {
    "AH04": said("The rule AMIGO."),
    "AH84": said("Gain and period from a relay test, by describing function."),
    "AH95": said("A model by hand from areas above and below a step response."),
    "B17": said("A relay with unequal levels, which shows the gain too."),
    "CC53": said("The rule of Cohen and Coon."),
    "CHR52": said("The rules of Chien, Hrones and Reswick, for set point and load, without and with overshoot."),
    "D07": said(
        "One gain for each move of a record, to see whether the process is linear; tuning by hand and measures of a "
        "response, in the lessons."
    ),
    "FL00": said("Fitting a model of an unstable process."),
    "GP73": said("Fitting: what enters linearly is eliminated, the rest is searched."),
    "GS18": said("Improved SIMC and iSIMC; SIMC as a path beside the optimum."),
    "H64": said("Outliers of a record weigh less in a fit."),
    "K54": said("Magnitude optimum and symmetrical optimum."),
    "K95": said("The T-sum rule."),
    "LPLB98": said("The rule of Lee, Park, Lee and Brosilow."),
    "M67": said("Rules for the least IAE and ITAE after a load."),
    "NW87": said("Standard errors of a fitted model where neighbouring residuals are alike."),
    "PSB": said(
        "Cascades by direct synthesis under a bound on Ms; all ten pairs of processes, on the cascade page and in the "
        "lessons."
    ),
    "R69": said("Rules for the least IAE and ITAE after a set point."),
    "RC00": said("Relay tests, in the lessons."),
    "RMS86": said("IMC rules for PI and PID; the bound on the model error; figures 3 to 5, in the lessons."),
    "S72": said("A model by hand from two points of a step response."),
    "SCH97": said("The rule of Schaedel."),
    "SG12": said(
        "Improved SIMC; the measure J against the best PI; plants that rules are compared on; retuning a loop that "
        "swings."
    ),
    "SK03": said("Half rule and SIMC rules, the rules T1 to T3 for zeros, tables 1 to 4."),
    "SK98": said(
        "The rules of 1998 for zeros, the rule for an unstable pole, retuning by eye; examples 1 to 9, in the lessons."
    ),
    "SS10": said("A model from the overshoot of a closed loop under P control."),
    "T84": said("The exact oscillation of a relay test."),
    "TL92": said("The rule of Tyreus and Luyben."),
    "V06": said("SIMC tables, choices of tau_c, examples 1 and 2."),
    "YIG07": said("A grid over the dead time before a fit, so that no wrong one is kept."),
    "ZN42": said(
        "Both rules of Ziegler and Nichols, by step response and by ultimate point; the steepest tangent of a step "
        "response."
    ),
}
MISPRINTS: dict[str, tuple[Text, ...]] = {
    "PSB": (
        said("Control law: b k_ia is printed, b k_a is meant."),
        said("Pair 9: k_db = 64.020 is printed, with which the loop is not stable; 2.0640 fits its Ms."),
    ),
    "SK03": (
        said("Tables, E5: the smallest lag is 0.008; the PID with its printed tau_I has Ms 1.83."),
        said("Tables, E8 and E3: the PID of E8 has Kc = 1.0 by the rule; that of E3 has Ms 1.498."),
    ),
    "SK98": (
        said(
            "Twice Kc = 0.5/k theta/tau1 is printed: it is tau1/theta, and the values 1.30 and 0.85 beside it are "
            "right."
        ),
        said("Example 1: tau_D = 7.7 is printed, it is 12."),
    ),
    "V06": (
        said(
            "Equation 7: choices of tau_c are printed as ranges, empty for tau1 > 8 theta; the larger values are meant."
        ),
        said("Equation numbers 19 and 20 are used twice."),
    ),
}
