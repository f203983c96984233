"""What people paste from programs, papers and other countries: the value meant, typed by hand from the meaning."""

import cmath
import re
from cmath import exp
from math import pi, sqrt

import control
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy import signal

from simc_core import parse_plant

AT = (0.13j, 0.3 + 0.7j, -0.04 + 1.9j)

NUMBERS = {
    "12 500/(5s+1)": lambda s: 12500 / (5 * s + 1),
    "1/((10 000s+1)(s+1))": lambda s: 1 / ((10000 * s + 1) * (s + 1)),
    "1/(1\u202f200 s+1)": lambda s: 1 / (1200 * s + 1),
    "1/(1\u00a0200 s+1)": lambda s: 1 / (1200 * s + 1),
    "1/(1\u2009200s)": lambda s: 1 / (1200 * s),
    "1 000/(5s+1)": lambda s: 1000 / (5 * s + 1),
    "1 234,5/(5s+1)": lambda s: 1234.5 / (5 * s + 1),
    "1'200/(5s+1)": lambda s: 1200 / (5 * s + 1),
    "1’200/(5s+1)": lambda s: 1200 / (5 * s + 1),
    "1,234.5/(5s+1)": lambda s: 1234.5 / (5 * s + 1),
    "1.234/(s+1)": lambda s: 1.234 / (s + 1),
    "1.234,5/(5s+1)": lambda s: 1234.5 / (5 * s + 1),
    "1.234.567,5/(3.600,0s+1)": lambda s: 1234567.5 / (3600 * s + 1),
    "0,005/(1,5s+1)": lambda s: 0.005 / (1.5 * s + 1),
    "2,5 e^{-3s}/(1,5s+1)": lambda s: 2.5 * exp(-3 * s) / (1.5 * s + 1),
    "10 000e^{-2s}/(12 000s+1)": lambda s: 10000 * exp(-2 * s) / (12000 * s + 1),
    "2·10^3/(5s+1)": lambda s: 2000 / (5 * s + 1),
    "2·10⁻³/(5s+1)": lambda s: 0.002 / (5 * s + 1),
    "2x10^3/(5s+1)": lambda s: 2000 / (5 * s + 1),
    r"2 \times 10^{-3}/(s+1)": lambda s: 0.002 / (s + 1),
    "2 10^3/(s+1)": lambda s: 2000 / (s + 1),
    "3.5E-02/(2.0E+01*s+1)": lambda s: 0.035 / (20 * s + 1),
    "1/(5e-3s+1)": lambda s: 1 / (0.005 * s + 1),
    "(1+2e-1s)/(s(3s+1))": lambda s: (1 + 0.2 * s) / (s * (3 * s + 1)),
    "exp(-1e-3s)/(s+1)": lambda s: exp(-0.001 * s) / (s + 1),
    r"\frac{0{,}5}{s+1}": lambda s: 0.5 / (s + 1),
    "11/5 e^{-20s}/(180s+1)": lambda s: 2.2 * exp(-20 * s) / (180 * s + 1),
    "２/（５s＋１）": lambda s: 2 / (5 * s + 1),
    "[0.01]/[0.005 0.06 0.1001]": lambda s: 0.01 / (0.005 * s**2 + 0.06 * s + 0.1001),
    "[1, 0.5]/[1, 2, 4]": lambda s: (s + 0.5) / (s**2 + 2 * s + 4),
    "[1 -2]/[1 2 3]*exp(-s)": lambda s: (s - 2) / (s**2 + 2 * s + 3) * exp(-s),
}

NAMES = {
    r"G_{a1} = \frac{2e^{-2s}}{5s+1}": lambda s: 2 * exp(-2 * s) / (5 * s + 1),
    r"G_{b1}(s) = \frac{0,5}{2s+1}": lambda s: 0.5 / (2 * s + 1),
    "Y(s)/U(s) = 2/(5s+1)": lambda s: 2 / (5 * s + 1),
    r"\frac{Y(s)}{U(s)} = \frac{2}{5s+1}": lambda s: 2 / (5 * s + 1),
    "G(s) = Y(s)/U(s) = 2/(5s+1)": lambda s: 2 / (5 * s + 1),
    r"\hat{G}(s) = \frac{2}{5s+1}": lambda s: 2 / (5 * s + 1),
    "G(s) := 2/(5s+1)": lambda s: 2 / (5 * s + 1),
    "G(s) ≈ 2/(5s+1)": lambda s: 2 / (5 * s + 1),
    "tf: 5/(10*s+1)": lambda s: 5 / (10 * s + 1),
    "Plant: 5/(10*s+1)": lambda s: 5 / (10 * s + 1),
    "heat_exchanger(s) = 2/(5s+1)": lambda s: 2 / (5 * s + 1),
    "temperature = 2/(5s+1)": lambda s: 2 / (5 * s + 1),
    "=2*EXP(-0.5*s)/(3*s+1)": lambda s: 2 * exp(-0.5 * s) / (3 * s + 1),
    "G = 2": lambda s: 2,
    "G_p(s)=3": lambda s: 3,
    "P(s) &= 2/(5s+1)": lambda s: 2 / (5 * s + 1),
}

CALLS = {
    "tf([1 2],[1 3 2],'InputDelay',0.5)": lambda s: (s + 2) / (s**2 + 3 * s + 2) * exp(-0.5 * s),
    "tf(2.3,[4 1],'inputdelay',0.5)": lambda s: 2.3 * exp(-0.5 * s) / (4 * s + 1),
    "tf(2.3,[4 1],'OutputDelay',0.5)": lambda s: 2.3 * exp(-0.5 * s) / (4 * s + 1),
    "tf(2.3,[4 1],'IODelay',0.5)": lambda s: 2.3 * exp(-0.5 * s) / (4 * s + 1),
    'tf(2.3,[4 1],"ioDelay",0.5)': lambda s: 2.3 * exp(-0.5 * s) / (4 * s + 1),
    "tf(2,[5 1],InputDelay=3)": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "tf(2,[5 1],'InputDelay',1,'OutputDelay',2)": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "tf(2,[5 1],'TimeUnit','minutes')": lambda s: 2 / (5 * s + 1),
    "tf(1, [4, 1.0])*delay(1)": lambda s: exp(-s) / (4 * s + 1),
    "ctrl.tf([1, .5, .05], [1, 0, 0, 0])": lambda s: (s**2 + 0.5 * s + 0.05) / s**3,
    "control.TransferFunction([2], [5, 1])": lambda s: 2 / (5 * s + 1),
    "signal.TransferFunction([2], [5, 1])": lambda s: 2 / (5 * s + 1),
    "co.tf([2],[5,1],0)": lambda s: 2 / (5 * s + 1),
    "signal.lti([2],[5,1])": lambda s: 2 / (5 * s + 1),
    "exp(-3*s)*tf(2,[5 1])": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "tf(2,[5 1]) * tf([1 1],[3 1])": lambda s: 2 / (5 * s + 1) * (s + 1) / (3 * s + 1),
    "tf(2, conv([5 1],[3 1]))": lambda s: 2 / ((5 * s + 1) * (3 * s + 1)),
    "tf([2,5],[1,3,2])": lambda s: (2 * s + 5) / (s**2 + 3 * s + 2),
    "tf([0,5],[1,3])": lambda s: 5 / (s + 3),
    "zpk([-1],[-2 -3],5)": lambda s: 5 * (s + 1) / ((s + 2) * (s + 3)),
    "zpk(-1,[-2,-3],5)": lambda s: 5 * (s + 1) / ((s + 2) * (s + 3)),
    "zpk([],[0 -3],5)": lambda s: 5 / (s * (s + 3)),
    "zpk([],[-1+2i -1-2i],5,'InputDelay',1)": lambda s: 5 * exp(-s) / ((s + 1) ** 2 + 4),
    "zpk([], [-1+2j, -1-2j], 5)": lambda s: 5 / ((s + 1) ** 2 + 4),
    "TransferFunction([1], [3, 2], 3.2)": lambda s: exp(-3.2 * s) / (3 * s + 2),
    "syslin('c',2/(5*%s+1))": lambda s: 2 / (5 * s + 1),
    "syslin('c', 2, 5*%s+1)": lambda s: 2 / (5 * s + 1),
    "G = tf(2,[5 1]); G.InputDelay = 0.5;": lambda s: 2 * exp(-0.5 * s) / (5 * s + 1),
    "s = tf('s'); P = 2*exp(-3*s)/(5*s+1);": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "s = tf('s')\nP = 2*exp(-3*s)/(5*s+1)\n": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "s=control.tf('s'); G=2/(5*s+1)": lambda s: 2 / (5 * s + 1),
    "s=%s; G=2/(5*s+1)": lambda s: 2 / (5 * s + 1),
    "s = poly(0,'s'); G=2/(5*s+1)": lambda s: 2 / (5 * s + 1),
    "syms s; G=2/(5*s+1)": lambda s: 2 / (5 * s + 1),
    "G1 = 2/(5s+1); G2 = 1/(s+1); G = G1*G2": lambda s: 2 / ((5 * s + 1) * (s + 1)),
}

SCRIPTS = {
    "num = [2]; den = [10 1]; G = tf(num,den)": lambda s: 2 / (10 * s + 1),
    "num = [1 2];\nden = [1 3 2];\nG = tf(num, den, 'InputDelay', 3);": (
        lambda s: (s + 2) * exp(-3 * s) / (s**2 + 3 * s + 2)
    ),
    "num = [1 2]; den = [1 3 2]": lambda s: (s + 2) / (s**2 + 3 * s + 2),
    "num = [1, 2], den = [1, 3, 2]": lambda s: (s + 2) / (s**2 + 3 * s + 2),
    "num = 2; den = conv([10 1],[5 1]); P = tf(num,den)": lambda s: 2 / ((10 * s + 1) * (5 * s + 1)),
    "num = np.array([2.0]); den = np.array([10.0, 1.0])": lambda s: 2 / (10 * s + 1),
    "K=2; T=10; G=tf(K,[T 1])": lambda s: 2 / (10 * s + 1),
    "K=2; T=10; L=3; G=tf(K,[T 1],'InputDelay',3)*exp(-L*s)": lambda s: 2 * exp(-6 * s) / (10 * s + 1),
    "K=2; T=10; num=[K]; den=[T 1]; G=tf(num,den)": lambda s: 2 / (10 * s + 1),
    "import control as ct\nG = ct.tf([2], [10, 1])": lambda s: 2 / (10 * s + 1),
    "import control as ct G = ct.tf([2], [10, 1])": lambda s: 2 / (10 * s + 1),
    "from control import tf; G = tf([2],[10,1])": lambda s: 2 / (10 * s + 1),
    "import sympy as sp\ns = sp.symbols('s')\nG = 2*sp.exp(-3*s)/(10*s+1)": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "pkg load control; G = tf(2,[10 1])": lambda s: 2 / (10 * s + 1),
    "s = zpk('s'); G = 2/(10*s+1)": lambda s: 2 / (10 * s + 1),
    "s=tf('s'), G=2*exp(-3*s)/(10*s+1)": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "s = tf('s');\nG = 2/(10*s+1);\nG.InputDelay = 3;": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "G = tf(2, ...\n [10 1])": lambda s: 2 / (10 * s + 1),
    "TransferFunction(s + 2, s**2 + 3*s + 2, s)": lambda s: (s + 2) / (s**2 + 3 * s + 2),
    "TransferFunction(2*exp(-3*s), 10*s + 1, s)": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "TransferFunction(num=[2], den=[10, 1])": lambda s: 2 / (10 * s + 1),
    "signal.lti([-1],[-2,-3],5)": lambda s: 5 * (s + 1) / ((s + 2) * (s + 3)),
    "signal.ZerosPolesGain([-1],[-2,-3],5)": lambda s: 5 * (s + 1) / ((s + 2) * (s + 3)),
    "Transfer function G(s) = 2/(10s+1)": lambda s: 2 / (10 * s + 1),
    "The plant is G(s) = 2/(10s+1)": lambda s: 2 / (10 * s + 1),
    "2*E**(-3*s)/(10*s+1)": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "(2 E^(-3 s))/(1 + 10 s)": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "2*%e^-(3*s)/(10*s+1)": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "exp(-3s)*tf(2,[10,1])": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "tf(1,[1,2])": lambda s: 1 / (s + 2),
    "tf([2],[10 1],'InputDelay',3)": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
}

CLUTTER = {
    "2/(5s+1)。": lambda s: 2 / (5 * s + 1),
    "2/(5s+1);": lambda s: 2 / (5 * s + 1),
    "2/(5s+1).": lambda s: 2 / (5 * s + 1),
    "2/(5s+1),": lambda s: 2 / (5 * s + 1),
    "2/(5s+1) ; ": lambda s: 2 / (5 * s + 1),
    "2/(5s+1) % plant": lambda s: 2 / (5 * s + 1),
    "2/(5s+1); % plant, K = 3": lambda s: 2 / (5 * s + 1),
    "2/(5s+1) # plant": lambda s: 2 / (5 * s + 1),
    "# plant\n2/(5s+1)": lambda s: 2 / (5 * s + 1),
    '"2/(5s+1)"': lambda s: 2 / (5 * s + 1),
    "'2/(5s+1)'": lambda s: 2 / (5 * s + 1),
    "`2/(5s+1)`": lambda s: 2 / (5 * s + 1),
    "```2/(5s+1)```": lambda s: 2 / (5 * s + 1),
    "$2/(5s+1)$": lambda s: 2 / (5 * s + 1),
    r"$G(s)=\frac{2}{5s+1}$.": lambda s: 2 / (5 * s + 1),
    r"$$\frac{2}{5s+1}$$": lambda s: 2 / (5 * s + 1),
    r"\(2/(5s+1)\)": lambda s: 2 / (5 * s + 1),
    r"\[ G(s) = \frac{2}{5s+1} e^{-3s} \]": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "\ufeff2/(5s+1)\u200b": lambda s: 2 / (5 * s + 1),
    "2/(5s+1) [°C/%]": lambda s: 2 / (5 * s + 1),
    "2 e^{-3 s}/(10 s + 1)  [K/kW]": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "2/(5s+1) [bar]": lambda s: 2 / (5 * s + 1),
}

LATEX = {
    r"\dfrac{2}{5s+1}": lambda s: 2 / (5 * s + 1),
    r"\tfrac{2}{5s+1} \mathrm{e}^{-2s}": lambda s: 2 * exp(-2 * s) / (5 * s + 1),
    r"\displaystyle \frac{2}{5s+1}": lambda s: 2 / (5 * s + 1),
    r"{2 \over 5s+1}": lambda s: 2 / (5 * s + 1),
    r"2 e^{-s} \over (5s+1)(s+1)": lambda s: 2 * exp(-s) / ((5 * s + 1) * (s + 1)),
    r"G(s) &= \frac{2\,e^{-2s}}{5s+1} \\": lambda s: 2 * exp(-2 * s) / (5 * s + 1),
    r"\frac{-1.5\,{\rm e}^{-4s}}{20s+1}": lambda s: -1.5 * exp(-4 * s) / (20 * s + 1),
    r"\frac{2 \exp\left(-3s\right)}{\left(5s+1\right)}": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    r"\begin{equation} G(s)=\frac{2}{5s+1} \end{equation}": lambda s: 2 / (5 * s + 1),
    r"\begin{aligned} G &= \frac{2}{5s+1} \nonumber \\ \end{aligned}": lambda s: 2 / (5 * s + 1),
    r"\frac{2}{\bigl(5s+1\bigr)\big(s+1\big)}": lambda s: 2 / ((5 * s + 1) * (s + 1)),
    r"\frac{1}{s^{2}+\sqrt{2}s+1}": lambda s: 1 / (s**2 + sqrt(2) * s + 1),
    r"2\cdot\frac{1}{5\,s+1}\quad": lambda s: 2 / (5 * s + 1),
}

LETTERS = {
    "0,5/(1+2p)": lambda s: 0.5 / (1 + 2 * s),
    "W(p) = 2/(p(5p+1))": lambda s: 2 / (s * (5 * s + 1)),
    "2e^{-3p}/(5p+1)": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "1/(5S+1)": lambda s: 1 / (5 * s + 1),
    "EXP(-2*S)/(S+1)": lambda s: exp(-2 * s) / (s + 1),
    "Exp[-2 s]/(1 + 10 s)": lambda s: exp(-2 * s) / (1 + 10 * s),
    "2/(5*%s+1)": lambda s: 2 / (5 * s + 1),
    "2*%e^(-3*%s)/(5*%s+1)": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "2e⁻³ˢ/(5s+1)": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "2e⁻ˢ/(5s+1)²": lambda s: 2 * exp(-s) / (5 * s + 1) ** 2,
    "(5s+1)⁻¹": lambda s: 1 / (5 * s + 1),
    "2÷(5s+1)": lambda s: 2 / (5 * s + 1),
    "𝐺(𝑠) = 2𝑒^{−3𝑠}/(5𝑠+1)": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "2 ℯ^(-3s)/(5s+1)": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "𝐾/(𝜏𝑠+1), 𝐾=2, 𝜏=5": lambda s: 2 / (5 * s + 1),
    "2s⁻¹e^{-s}": lambda s: 2 * exp(-s) / s,
    "2 (5s+1)⁻¹ e⁻³ˢ": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "2∕(5s+1)": lambda s: 2 / (5 * s + 1),
    "2⋅e^(−3⋅s)/(5⋅s+1)": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "2*e**(-3*s)/(5*s+1)": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
    "np.exp(-2*s)/(s+1)": lambda s: exp(-2 * s) / (s + 1),
    "numpy.exp(-2*s)/(s+1)": lambda s: exp(-2 * s) / (s + 1),
    "math.exp(-2*s)/(s+1)": lambda s: exp(-2 * s) / (s + 1),
    "1./(s+1).^3": lambda s: 1 / (s + 1) ** 3,
    "2.*exp(-s)./(5.*s+1)": lambda s: 2 * exp(-s) / (5 * s + 1),
    "1/(s^2+sqrt(2)*s+1)": lambda s: 1 / (s**2 + sqrt(2) * s + 1),
    "1/(s²+√2 s+1)": lambda s: 1 / (s**2 + sqrt(2) * s + 1),
    "2*pi/(s+2*pi)": lambda s: 2 * pi / (s + 2 * pi),
    "2π/(s+2π)": lambda s: 2 * pi / (s + 2 * pi),
    "np.pi/(s+np.pi)": lambda s: pi / (s + pi),
    "sqrt(2)/(s+1)": lambda s: sqrt(2) / (s + 1),
}

PARAMETERS = {
    "Km=2.5, Tm=8, Taum=1.2": lambda s: 2.5 * exp(-1.2 * s) / (8 * s + 1),
    "k=2, tau=10, theta=3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "k = 2; tau = 10; theta = 3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "k = 2\ntau = 10\ntheta = 3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "k=2 tau=10 theta=3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "theta=3, tau=10, k=2": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "k=2,5, tau=10,5, theta=0,5": lambda s: 2.5 * exp(-0.5 * s) / (10.5 * s + 1),
    "K = 2, T = 10, L = 3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "Kp=2, Tp=10, Td=3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    r"K=2, \tau_1=10, \tau_2=5, \theta=3": lambda s: 2 * exp(-3 * s) / ((10 * s + 1) * (5 * s + 1)),
    "k=11/5, τ=10, θ=3": lambda s: 2.2 * exp(-3 * s) / (10 * s + 1),
    "gain=2, time constant=10, dead time=3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "K=2, T=10": lambda s: 2 / (10 * s + 1),
    "k=2, tau=5, zeta=0.3, theta=1": lambda s: 2 * exp(-s) / (25 * s**2 + 3 * s + 1),
    "G(s)=1/(s(s+1)^2), L=0.5": lambda s: exp(-0.5 * s) / (s * (s + 1) ** 2),
    "1/(s(s+1)^2), L=0,5": lambda s: exp(-0.5 * s) / (s * (s + 1) ** 2),
    "2/(5s+1); theta=2": lambda s: 2 * exp(-2 * s) / (5 * s + 1),
    "2/(5s+1) with dead time = 2": lambda s: 2 * exp(-2 * s) / (5 * s + 1),
    "K/(T*s+1), K=2, T=5, L=1": lambda s: 2 * exp(-s) / (5 * s + 1),
    "Gp(s)=K/(Ts+1), K=2, T=5": lambda s: 2 / (5 * s + 1),
    "K=2; T=10; G = K/(T*s+1)": lambda s: 2 / (10 * s + 1),
    r"K e^{-\theta s}/(\tau s+1), K=2, \theta = 3, \tau=10": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    r"\frac{K e^{-Ls}}{Ts+1}; K=2; T=5; L=1": lambda s: 2 * exp(-s) / (5 * s + 1),
    "K/(s+p), K=2, p=3": lambda s: 2 / (s + 3),
    "k=2, theta=3, tau=10": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "k: 2, tau: 10, theta: 3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "K: 2,5; T: 10; L: 0,5": lambda s: 2.5 * exp(-0.5 * s) / (10 * s + 1),
    "Kp = 2\nTp1 = 10\nTd = 3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "Gain=2 Lag=10 Delay=3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "process gain = 2, time constant = 10, time delay = 3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "FOPDT: K=2, tau=10, theta=3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "first order plus dead time, K=2, T=10, L=3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "SOPDT: K=2, tau1=10, tau2=5, theta=3": lambda s: 2 * exp(-3 * s) / ((10 * s + 1) * (5 * s + 1)),
    r"\frac{K}{\tau s+1}e^{-\theta s}\quad K=2,\ \tau=10,\ \theta=3": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "wn=2; zeta=0.5; G = wn^2/(s^2+2*zeta*wn*s+wn^2)": lambda s: 4 / (s**2 + 2 * s + 4),
    "H(p) = K/(1+T p), K=2, T=10": lambda s: 2 / (10 * s + 1),
}

MATLAB = (
    "\nG =\n \n                  5\n  exp(-2*s) * --------\n              10 s + 1\n \n"
    "Continuous-time transfer function.\n"
)
OCTAVE = (
    "\nTransfer function 'G' from input 'u1' to output ...\n\n         5\n y1:  --------\n      10 s + 1\n\n"
    "Continuous-time model."
)
DRAWN = {
    MATLAB: lambda s: 5 * exp(-2 * s) / (10 * s + 1),
    MATLAB.replace("\n", " "): lambda s: 5 * exp(-2 * s) / (10 * s + 1),
    OCTAVE: lambda s: 5 / (10 * s + 1),
    OCTAVE.replace("\n", " "): lambda s: 5 / (10 * s + 1),
    "           s + 2\nexp(-2*s) * -----------\n            s^2 + 3 s + 2": (
        lambda s: (s + 2) * exp(-2 * s) / (s**2 + 3 * s + 2)
    ),
    "   5 (s+1)\n  -----------\n  (s+2) (s+3)": lambda s: 5 * (s + 1) / ((s + 2) * (s + 3)),
    "1\n-\ns": lambda s: 1 / s,
    "2\n─\ns": lambda s: 2 / s,
    "2 ⎯⎯⎯⎯ 10s+1": lambda s: 2 / (10 * s + 1),
    "         2\nG(s) = ------\n       10s+1": lambda s: 2 / (10 * s + 1),
    "   2   G(s) = ------   10s+1": lambda s: 2 / (10 * s + 1),
    "   2\n-------\n 2\ns  + 3 s + 1": lambda s: 2 / (s**2 + 3 * s + 1),
    "       2\n  ------------\n   2\n  s  + 3 s + 1": lambda s: 2 / (s**2 + 3 * s + 1),
    "      2      \n─────────────\n 3      2      \ns  + 3⋅s  + 1 ": lambda s: 2 / (s**3 + 3 * s**2 + 1),
    "0.5\n───\n  2\n s ": lambda s: 0.5 / s**2,
    "1\n--\n 2\ns": lambda s: 1 / s**2,
    "     -3s\n  2 e\n ---------\n  10 s + 1": lambda s: 2 * exp(-3 * s) / (10 * s + 1),
    "    1\n----------\n         2\n(5 s + 1)": lambda s: 1 / (5 * s + 1) ** 2,
    "TransferFunction{Continuous, Float64}\n    2.0\n-----------\n10.0s + 1.0\n\n"
    "Continuous-time transfer function model": lambda s: 2 / (10 * s + 1),
    MATLAB + "Model Properties": lambda s: 5 * exp(-2 * s) / (10 * s + 1),
    "#      2\n#  ---------\n#   5 s + 1": lambda s: 2 / (5 * s + 1),
    "%  s + 2 %  ------ %  5 s + 1": lambda s: (s + 2) / (5 * s + 1),
    "exp(-2*s) * 5 ----- 10 s + 1": lambda s: 5 * exp(-2 * s) / (10 * s + 1),
    "2\n───────\n5 s + 1": lambda s: 2 / (5 * s + 1),
    "G(s) =   2 e^{-3s}\n       ------------\n         5s + 1": lambda s: 2 * exp(-3 * s) / (5 * s + 1),
}

MEANT = NUMBERS | NAMES | CALLS | SCRIPTS | CLUTTER | LATEX | LETTERS | PARAMETERS | DRAWN


@pytest.mark.parametrize("text", MEANT, ids=lambda text: " ".join(text.split()))
def test_the_value_meant(text):
    plant = parse_plant(text)
    for s in AT:
        assert complex(plant.response(s)) == pytest.approx(complex(MEANT[text](s)), rel=1e-9)


times = st.integers(1, 9999).map(lambda n: n / 100)
signs = st.sampled_from((1, -1))


@st.composite
def rational(draw):
    """Coefficients of a proper transfer function with a gain at s = 0, and a dead time."""
    poles = draw(st.lists(times, min_size=1, max_size=3))
    zeros = draw(st.lists(st.tuples(signs, times), max_size=len(poles)))
    den = np.poly([-round(1 / tau, 4) - 1e-4 for tau in poles]).round(8)
    num = np.round(draw(times) * draw(signs) * np.poly([-sign * round(1 / tau, 4) - 1e-4 for sign, tau in zeros]), 8)
    return np.atleast_1d(num), den, draw(times)


def matlab(values) -> str:
    return f"[{' '.join(map(repr, map(float, values)))}]"


def powers(values, times: str = "*", power: str = "^") -> str:
    n = len(values) - 1
    return " + ".join(f"({float(c)!r}){times}s{power}{n - i}" for i, c in enumerate(values)).replace("e", "E")


WRITERS = {
    "matlab": lambda num, den, t: f"G = tf({matlab(num)}, {matlab(den)}, 'InputDelay', {t!r});",
    "matlab times exp": lambda num, den, t: f"exp(-{t!r}*s)*tf({matlab(num)}, {matlab(den)})",
    "python-control": lambda num, den, t: f"ct.tf({num.tolist()}, {den.tolist()})*exp(-{t!r}*s)",
    "scipy": lambda num, den, t: f"signal.TransferFunction({num.tolist()}, {den.tolist()}) * exp(-{t!r}*s)",
    "scipy printed": lambda num, den, t: f"{signal.TransferFunction(num, den)!r}*exp(-{t!r}*s)",
    "scilab": lambda num, den, t: (
        f"syslin('c', ({powers(num).replace('s', '%s')})/({powers(den).replace('s', '%s')}))*exp(-{t!r}*%s)"
    ),
    "sympy": lambda num, den, t: f"({powers(num, power='**')})*exp(-{t!r}*s)/({powers(den, power='**')})",
    "latex": lambda num, den, t: (
        rf"$G(s) = \frac{{{powers(num, ' ')}}}{{{powers(den, ' ')}}} \mathrm{{e}}^{{-{t!r} s}}$"
    ),
    "drawn": lambda num, den, t: f"  {powers(num, ' ')}\n exp(-{t!r}*s) * --------\n {powers(den, ' ')}",
    "one line": lambda num, den, t: f"  {powers(num, ' ')}  exp(-{t!r}*s) * --------  {powers(den, ' ')}",
    "decimal commas": lambda num, den, t: f"({powers(num)})*e^(-{t!r}*s)/({powers(den)})".replace(".", ",").replace(
        "-", "−"
    ),
}


@settings(deadline=None, max_examples=40)
@given(rational(), st.sampled_from(list(WRITERS)))
def test_plants_written_by_programs_read_back(given_plant, writer):
    num, den, theta = given_plant
    text = WRITERS[writer](num, den, theta)
    assume(len(text) < 1500 and "e-" not in text.replace("e^-", ""))
    # exactly three decimals after a comma have a second reading
    assume(writer != "decimal commas" or not re.search(r"(?<!\d)[1-9]\d{0,2},\d{3}(?!\d)", text))
    plant = parse_plant(text)
    for s in AT:
        meant = np.polyval(num, s) / np.polyval(den, s) * cmath.exp(-theta * s)
        assert complex(plant.response(s)) == pytest.approx(meant, rel=1e-6)


@pytest.mark.parametrize("show", [str, repr])
@pytest.mark.parametrize(
    ("num", "den"), [([1, 2], [1, 3, 1]), ([2], [5, 1]), ([1], [1, 0]), ([-3.5], [2, 1, 0]), ([0.5, -1], [4, 2, 3, 1])]
)
def test_what_python_control_prints_reads_back(num, den, show):
    """Newlines kept, or made blanks as a text field of a page does."""
    printed = show(control.tf(num, den))
    for text in (printed, printed.replace("\n", " ")) if len(den) > 2 or den[-1] else (printed,):
        for s in AT:
            assert complex(parse_plant(text).response(s)) == pytest.approx(
                np.polyval(num, s) / np.polyval(den, s), rel=1e-9
            )
